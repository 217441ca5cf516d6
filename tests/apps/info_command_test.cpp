#include <gelatin/version.h>

#include <numeric>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class InfoCommand : public ProgramTest {};

TEST_F(InfoCommand, TellsAboutTheMachine) {
    const ProgramResult result = run({"info", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["version"], version());
    EXPECT_EQ(info["commit"], commit());
    EXPECT_NE(info["cpu"]["simd"], "");
    EXPECT_GE(info["cpu"]["threads"], 1);
    EXPECT_TRUE(info["opengl"]["default"].contains("renderer") ||
                info["opengl"]["default"].contains("unusable"));
    EXPECT_THAT(run({"info"}).out, HasSubstr(std::string("version: ") + version() + "\n"));
}

TEST_F(InfoCommand, WorksWhereThereIsNoOpenGl) {
    settings_.environment.emplace_back("__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent");
    const ProgramResult result = run({"info", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(json::parse(result.out)["opengl"]["default"].contains("unusable"));
}

TEST_F(InfoCommand, TellsAboutAScene) {
    const ProgramResult result = run({"info", "cube.toml", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["kind"], "scene");
    EXPECT_EQ(info["counts"]["objects"], 1);
    EXPECT_EQ(info["counts"]["springs"], info["objects"]["cube"]["springs"]);
    EXPECT_EQ(info["objects"]["cube"]["faces"], 108);  // 6 sides of 3 x 3 squares
    EXPECT_NEAR(info["objects"]["cube"]["mass"].get<double>(), 1000.0, 1e-6);
    EXPECT_NEAR(info["objects"]["cube"]["volume"].get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(info["step_size"].get<double>() * info["substeps"].get<int>(), 0.01, 1e-15);
}

TEST_F(InfoCommand, NeedsNoOpenGlForASceneThatDoes) {
    write("depth.toml", read_file(path("cube.toml")) + "\n[collision]\nbroad_phase = 'depth'\n");
    const ProgramResult result = run({"info", "depth.toml", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["counts"]["objects"], 1);
}

// With what only contact has.
TEST_F(InfoCommand, TellsAboutASceneWithContact) {
    write("wall.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n");
    write(
        "contact.toml",
        "[collision]\nresponse = 'contact'\n[[material]]\nname = 'jelly'\nfriction = 0.2\n[[object]]\n"
        "name = 'ball'\nshape = {sphere = 0.3, frequency = 3}\n[[collider]]\nshape = {file = 'wall.obj'}\n");
    const ProgramResult result = run({"info", "contact.toml", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(json::parse(result.out)["counts"]["objects"], 1);
    EXPECT_EQ(json::parse(result.out)["objects"].size(), 1u);
}

// A triangle through another one, and one beside them that shares a vertex with the second.
TEST_F(InfoCommand, CountsCrossingsOfASurface) {
    const std::string apart =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 0.1\nv 0.3 0.2 1\nv 0.2 0.3 1\nv 3 3 3\n"
        "v 4 3 3\nf 1 2 3\nf 4 5 6\nf 4 7 8\n";
    std::string crossing = apart;
    crossing.replace(crossing.find("0.1\n"), 3, "-1.");
    write("apart.obj", apart);
    write("crossing.obj", crossing);
    EXPECT_EQ(json::parse(run({"info", "apart.obj", "--json"}).out)["crossings"], 0);
    EXPECT_EQ(json::parse(run({"info", "crossing.obj", "--json"}).out)["crossings"], 1);
}

TEST_F(InfoCommand, TellsAboutASurface) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    const ProgramResult result = run({"info", "open.obj", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["kind"], "surface");
    EXPECT_EQ(info["vertices"], 4);
    EXPECT_EQ(info["faces"], 3);
    EXPECT_EQ(info["closed"], false);
    EXPECT_EQ(info["boundary_edges"], 3);
    EXPECT_FALSE(info.contains("volume"));
    EXPECT_EQ(info["extent"]["max"], (std::vector<double>{1.0, 1.0, 1.0}));
}

TEST_F(InfoCommand, TellsAboutTets) {
    write("one.mesh",
          "MeshVersionFormatted 1\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
          "Tetrahedra 1\n1 2 4 3 0\nEnd\n");  // inside out
    const ProgramResult result = run({"info", "one.mesh", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["kind"], "tets");
    EXPECT_EQ(info["edges"], 6);
    EXPECT_NEAR(info["volume"].get<double>(), 1.0 / 6.0, 1e-15);
    EXPECT_EQ(info["notes"].size(), 1u);  // flipped
}

// A regular tet, whose angles are 70.5 degrees, and the corner of a cube: three right angles, three of 54.7.
TEST_F(InfoCommand, DrawsHistogramsOfTets) {
    write("two.mesh",
          "MeshVersionFormatted 1\nDimension 3\nVertices 8\n1 1 1 0\n1 -1 -1 0\n-1 1 -1 0\n-1 -1 1 0\n"
          "5 0 0 0\n6 0 0 0\n5 1 0 0\n5 0 1 0\nTetrahedra 2\n1 2 4 3 0\n5 6 7 8 0\nEnd\n");
    const json info = json::parse(run({"info", "two.mesh", "--json"}).out);
    const json angles = info["dihedral_angle"]["histogram"], radii = info["radius_ratio"]["histogram"];
    EXPECT_EQ(angles["to"], 180.0);
    const auto counts = angles["counts"].get<std::vector<int>>();
    EXPECT_EQ(counts[5], 3);
    EXPECT_EQ(counts[7], 6);
    EXPECT_EQ(counts[8] + counts[9], 3) << "90 degrees, but for rounding";
    EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 12);
    // The corner's radii are 1 / (3 + sqrt(3)) and sqrt(3) / 2, its ratio is 0.732. The regular one has 1.
    EXPECT_EQ(radii["counts"], json({0, 0, 0, 0, 0, 0, 0, 1, 0, 1}));
    const std::string text = run({"info", "two.mesh"}).out;
    EXPECT_THAT(text, HasSubstr("  50 to   60:        3 " + std::string(25, '#') + "\n"));
    EXPECT_THAT(text, HasSubstr("  70 to   80:        6 " + std::string(50, '#') + "\n"));
    EXPECT_THAT(text, HasSubstr("   0 to   10:        0\n"));
    EXPECT_THAT(text, HasSubstr(" 0.9 to    1:        1 "));
}

TEST_F(InfoCommand, RefusesWhatItCannotRead) {
    for (const char* name : {"missing.obj", "missing.vtk", "missing.txt", "missing"})
        expect_error({"info", name}, 2, std::string(name) + ": no such file");
    write("cube", "no ending");
    expect_error({"info", "cube"}, 2,
                 "cube: a surface file must end in .obj, .stl, .ply, .off, .gltf or .glb");
    expect_error({"info", "missing.toml"}, 2, "missing.toml: no such file");
}

}  // namespace
}  // namespace gelatin::test
