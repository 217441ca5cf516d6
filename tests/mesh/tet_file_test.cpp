#include "mesh/tet_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/topology.h"
#include "tet_file_fixture.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_pair(const TetMesh& mesh) {
    EXPECT_EQ(mesh.positions, kPair.positions);
    EXPECT_EQ(mesh.tets, kPair.tets);
    EXPECT_EQ(mesh.faces, boundary_faces(kPair.tets));
    EXPECT_EQ(mesh.faces.size(), 6u);
}

TEST_F(TetFileTest, KnowsItsEndings) {
    for (const char* name : {"a.node", "a.ele", "a.mesh", "a.MSH", "a.vtk", "a.vtu"})
        EXPECT_TRUE(is_tet_file(name)) << name;
    for (const char* name : {"a.obj", "a.vtp", "mesh", "a.meshb"}) EXPECT_FALSE(is_tet_file(name)) << name;
}

TEST_F(TetFileTest, ReadsWhatItWrites) {
    TetMesh mesh = kPair;
    mesh.faces = boundary_faces(mesh.tets);
    for (const char* name : {"b.node", "b.mesh", "b.msh"}) {
        write_tets(path(name), mesh);
        notes_.clear();
        expect_pair(read_tets(path(name), notes_));
    }
    expect_pair(read_tets(path("b.ele"), notes_));
    EXPECT_TRUE(fs::exists(path("b.face")));
}

TEST_F(TetFileTest, WritesVtu) {
    write_tets(path("a.vtu"), kPair);
    const std::string vtu = read_file(path("a.vtu"));
    EXPECT_THAT(vtu, HasSubstr("NumberOfPoints=\"5\" NumberOfCells=\"2\""));
    EXPECT_THAT(vtu, HasSubstr(">\n" + kPositions + "</DataArray>"));
    EXPECT_THAT(vtu, HasSubstr("Name=\"connectivity\" format=\"ascii\">\n0 1 2 3\n0 2 1 4\n</DataArray>"));
    EXPECT_THAT(vtu, HasSubstr("Name=\"offsets\" format=\"ascii\">\n4\n8\n</DataArray>"));
    EXPECT_THAT(vtu, HasSubstr("Name=\"types\" format=\"ascii\">\n10\n10\n</DataArray>"));
}

TEST_F(TetFileTest, WritesWholeOrNotAtAll) {
    EXPECT_THAT(refusal([&] { write_tets(path("a.stl"), kPair); }), HasSubstr(".node, .mesh, .msh or .vtu"));
    EXPECT_THROW(write_tets("/no/such/folder/a.node", kPair), SystemError);
    fs::create_directory(path("a.face"));  // in the way of one of three
    EXPECT_THROW(write_tets(path("a.node"), kPair), SystemError);
    EXPECT_FALSE(fs::exists(path("a.node")));
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
        EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("partial")));
    }
}

TEST_F(TetFileTest, ReadsTetGenCountedFromZeroOrOne) {
    const std::string nodes0 =
        "# by hand\n5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1 # top\n4 0.1 0.2 -0.3333333333333333\n";
    expect_pair(read_tetgen(nodes0, "2 4 0\n0 0 1 2 3\n1 0 2 1 4\n# end\n"));
    const std::string nodes1 =
        "5 3 2 1\n\n1 0 0 0 9.5 -1 1\n2 1 0 0 9 9 1\n3 0 1 0 9 9 -1\n4 0 0 1 9 9 0\n5 0.1 0.2 "
        "-0.3333333333333333 9 9 1\n";
    expect_pair(read_tetgen(nodes1, "2 4 1\n1 1 2 3 4 17\n2 1 3 2 5 -17\n"));
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(TetFileTest, ReadsShortTetGenHeaders) {
    const std::string nodes = "5 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0.1 0.2 -0.3333333333333333\n";
    expect_pair(read_tetgen(nodes, "2\n0 0 1 2 3\n1 0 2 1 4\n"));
}

TEST_F(TetFileTest, KeepsTheCornersOfQuadraticTets) {
    std::string nodes = "10 3 0 0\n";
    const std::string corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
    for (int n = 0; n < 10; ++n) nodes += std::to_string(n) + " " + (n < 4 ? corners[n] : "0.5 0 0") + "\n";
    const TetMesh mesh = read_tetgen(nodes, "1 10 0\n0 0 1 2 3 4 5 6 7 8 9\n");
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.tets.size(), 1u);
    EXPECT_THAT(notes_, ElementsAre("kept the corners only of cells with more nodes: 1",
                                    "discarded nodes without tets: 6"));
}

TEST_F(TetFileTest, ReadsMedit) {
    expect_pair(read("a.mesh", kMedit));
    EXPECT_THAT(notes_, IsEmpty());
    expect_pair(read("a.mesh", replaced(kMedit, "Dimension 3", "Dimension\n3\n# a comment\n")));
    expect_pair(read("a.mesh", replaced(kMedit, "\nEnd\n", "")));
}

TEST_F(TetFileTest, SkipsOtherSectionsOfMedit) {
    const std::string others =
        "Triangles 2\n1 2 3 0\n1 2 4 0\nRequiredVertices\n1\n1\nCorners 0\nNormals\n1\n-0.5 .5 "
        "1e-3\nTetrahedra";
    expect_pair(read("a.mesh", replaced(kMedit, "Tetrahedra", others)));
    EXPECT_THAT(notes_,
                ElementsAre("skipped Normals: 1", "skipped RequiredVertices: 1", "skipped Triangles: 2"));
}

TEST_F(TetFileTest, ReadsGmshInText) {
    expect_pair(read("a.msh", kGmsh2));
    EXPECT_THAT(notes_, IsEmpty());
    expect_pair(read("a.msh", kGmsh4));
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(TetFileTest, ReadsGmshInBytesOfEitherOrder) {
    for (const bool swapped : {false, true}) {
        expect_pair(read("a.msh", binary_gmsh2(swapped)));
        EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 2"));
        expect_pair(read("a.msh", binary_gmsh4(swapped)));
        EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 1"));
    }
}

TEST_F(TetFileTest, SkipsOtherElementsOfGmsh) {
    const std::string msh2 =
        replaced(kGmsh2, "$Elements\n2\n", "$Elements\n4\n8 15 2 0 1 10\n9 2 3 0 1 -5 10 20 30\n");
    expect_pair(read("a.msh", msh2));
    EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 2"));
    const std::string msh4 =
        replaced(kGmsh4, "1 2 1 2\n3 1 4 2\n", "2 4 1 9\n2 1 2 2\n8 10 20 30\n9 10 20 5\n3 1 4 2\n");
    expect_pair(read("a.msh", msh4));
    EXPECT_THAT(notes_, ElementsAre("ignored points, lines and surfaces: 2"));
}

TEST_F(TetFileTest, KeepsTheCornersOfQuadraticTetsOfGmsh) {
    const std::string msh =
        replaced(kGmsh2, "1 4 2 1 1 10 20 30 5", "1 11 2 1 1 10 20 30 5 10 10 10 10 10 10");
    expect_pair(read("a.msh", msh));
    EXPECT_THAT(notes_, ElementsAre("kept the corners only of cells with more nodes: 1"));
}

// Gmsh writes an element of two physical groups twice.
TEST_F(TetFileTest, DropsRepeatedTets) {
    const std::string msh = replaced(kGmsh2, "$Elements\n2\n", "$Elements\n3\n7 4 0 20 30 10 5\n");
    const TetMesh mesh = read("a.msh", msh);
    EXPECT_THAT(notes_, ElementsAre("discarded duplicate tets: 1"));
    EXPECT_EQ(mesh.tets.size(), 2u);
    EXPECT_EQ(mesh.faces.size(), 6u);
}

TEST_F(TetFileTest, TurnsTetsThatAreInsideOut) {
    const TetMesh mesh = read("a.mesh", replaced(kMedit, "1 2 3 4 1", "2 1 3 4 1"));
    EXPECT_THAT(notes_, ElementsAre("flipped inverted tets: 1"));
    EXPECT_GT(tet_volume(mesh, mesh.tets[0]), 0.0);
    EXPECT_DOUBLE_EQ(tet_volume(mesh, mesh.tets[0]), 1.0 / 6.0);
}

TEST_F(TetFileTest, DropsUnusedNodes) {
    const std::string medit = replaced(replaced(kMedit, "Vertices\n5\n", "Vertices\n7\n9 9 9 0\n8 8 8 0\n"),
                                       "1 2 3 4 1\n1 3 2 5 1", "3 4 5 6 1\n3 5 4 7 1");
    expect_pair(read("a.mesh", medit));
    EXPECT_THAT(notes_, ElementsAre("discarded nodes without tets: 2"));
}

// Were the counts believed, these would end in std::bad_alloc or take all memory.
}  // namespace
}  // namespace gelatin
