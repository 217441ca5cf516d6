#include "apps/program_test.h"
#include "mesh/surface_file.h"
#include "mesh/tet_file.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;

class MeshCommand : public ProgramTest {
protected:
    MeshCommand() {
        write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    }
};

TEST_F(MeshCommand, MakesTetsAndReportsThem) {
    const ProgramResult result = run({"mesh", "tetrahedron.obj", "-o", "out.msh", "--max-volume", "0.01"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    Notes notes;
    const TetMesh mesh = read_tets(path("out.msh"), notes);
    EXPECT_GT(mesh.tets.size(), 16u);  // 1/6 m^3 in pieces of 0.01 at most
    EXPECT_THAT(result.out, HasSubstr("tets: " + std::to_string(mesh.tets.size()) + "\n"));
    EXPECT_THAT(result.out, HasSubstr("nodes: " + std::to_string(mesh.positions.size()) + "\n"));
    EXPECT_THAT(result.out, HasSubstr("volume: 0.166667\n"));
    EXPECT_THAT(result.out, HasSubstr("radius_edge_ratio:\n  min: "));
    EXPECT_THAT(result.out, HasSubstr("file: out.msh\n"));
}

TEST_F(MeshCommand, ReportsTheQualityOfARegularTet) {
    // Edges of 2 sqrt(2), circumscribed radius sqrt(3).
    write("regular.mesh",
          "MeshVersionFormatted 1\nDimension 3\nVertices 4\n1 1 1 0\n1 -1 -1 0\n-1 1 -1 0\n-1 -1 1 0\n"
          "Tetrahedra 1\n1 2 4 3 0\nEnd\n");
    const ProgramResult result = run({"mesh", "regular.mesh", "-o", "out.vtu"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("radius_edge_ratio:\n  min: 0.612372\n  max: 0.612372\n"));
    EXPECT_THAT(result.out, HasSubstr("volume: 2.66667\n"));
}

TEST_F(MeshCommand, ReadsFilesOfVtk) {
    write(
        "one.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 "
        "0 0 1\nCELLS 2 9\n3 0 1 2\n4 0 1 2 3\nCELL_TYPES 2\n5 10\nCELL_DATA 2\nSCALARS region int\n0 4\n");
    const ProgramResult info = run({"info", "one.vtk"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("volume: 0.166667\n"));
    EXPECT_THAT(info.err, HasSubstr("gelatin: note: ignored points, lines and surfaces: 1"));
    ASSERT_EQ(run({"mesh", "one.vtk", "-o", "one.vtu"}).exit_code, 0);
    ASSERT_EQ(run({"mesh", "one.vtu", "-o", "one.msh"}).exit_code, 0);
    Notes notes;
    const TetMesh mesh = read_tets(path("one.msh"), notes);
    EXPECT_EQ(mesh.tets.size(), 1u);
    EXPECT_EQ(mesh.attributes, std::vector<int>{4});
}

TEST_F(MeshCommand, ConvertsTetsToTheirSurface) {
    ASSERT_EQ(run({"mesh", "tetrahedron.obj", "-o", "out.node", "--max-volume", "0.001"}).exit_code, 0);
    const ProgramResult result = run({"mesh", "out.node", "-o", "surface.off"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    Notes notes;
    const TetMesh tets = read_tets(path("out.node"), notes);
    const SurfaceMesh surface = read_surface(path("surface.off"), notes);
    EXPECT_EQ(surface.faces.size(), tets.faces.size());
    EXPECT_LT(surface.positions.size(), tets.positions.size());  // inner nodes are left out
    EXPECT_THAT(result.out, HasSubstr("closed: yes\n"));
}

TEST_F(MeshCommand, ConvertsSurfacesAndTellsOfRepairs) {
    write("doubled.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\nf 1 3 2\nf 5 2 4\nf 2 3 4\nf 1 4 3\n");
    const ProgramResult result = run({"mesh", "doubled.obj", "-o", "out.stl"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gelatin: note: "));
    EXPECT_THAT(result.out, HasSubstr("vertices: 4\nfaces: 4\n"));
    EXPECT_TRUE(exists("out.stl"));
}

TEST_F(MeshCommand, RefusesWrongCalls) {
    expect_error({"mesh", "missing.obj", "-o", "out.msh"}, 2, "missing.obj: no such file");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.xyz"}, 2,
                 "-o = out.xyz: must end in .node, .ele, .mesh, .msh, .vtu, .obj, .stl, .ply or .off");
    expect_error({"mesh", "tetrahedron.obj", "-o", "missing/out.msh"}, 2,
                 "-o = missing/out.msh: there is no folder missing");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--quality", "1"}, 2,
                 "--quality = 1: must be greater than 1");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--quality", "nan"}, 2,
                 "--quality = nan: must be greater than 1");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--max-volume", "0"}, 2,
                 "--max-volume = 0: must be greater than 0");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--mesher", "tetgn"}, 2,
                 "--mesher = tetgn: must be auto, tetgen or lattice (did you mean \"tetgen\"?)");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.ply", "--quality", "1.5"}, 2,
                 "--mesher, --nodes, --cell-size, --quality, --max-volume and --time-limit are for making "
                 "tets of a surface; out.ply takes "
                 "none");
    EXPECT_EQ(run({"mesh", "tetrahedron.obj"}).exit_code, 2);
}

TEST_F(MeshCommand, MakesAboutTheWantedNodes) {
    const auto nodes_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments = {"mesh", "tetrahedron.obj", "-o", "out.msh"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        Notes notes;
        return static_cast<double>(read_tets(path("out.msh"), notes).positions.size());
    };
    EXPECT_NEAR(nodes_with({}), 5000.0, 1000.0);
    for (const char* mesher : {"auto", "tetgen", "lattice"})
        EXPECT_NEAR(nodes_with({"--mesher", mesher, "--nodes", "600"}), 600.0, 120.0) << mesher;
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--mesher", "tetgen", "--cell-size", "1"}, 2,
                 "--cell-size is only for the lattice, not for --mesher tetgen");
    expect_error({"mesh", "tetrahedron.obj", "-o", "out.msh", "--nodes", "600", "--max-volume", "1"}, 2,
                 "of --nodes, --cell-size and --max-volume one at most can be given");
}

TEST_F(MeshCommand, RefusesASurfaceThatIsNotClosed) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    const ProgramResult result = run({"mesh", "open.obj", "-o", "out.msh", "--mesher", "tetgen"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("not closed"));
    EXPECT_FALSE(exists("out.msh"));
    EXPECT_EQ(run({"mesh", "open.obj", "-o", "out.ply"}).exit_code, 0);  // a surface need not be
}

}  // namespace
}  // namespace gelatin::test
