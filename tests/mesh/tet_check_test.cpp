#include "mesh/tet_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tet_file_fixture.h"

namespace gelatin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TetCheck, RoundnessIsOneForARegularTetOfAnySize) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        const glm::dvec3 a(size, size, size), b(size, -size, -size), c(-size, size, -size),
            d(-size, -size, size);
        EXPECT_NEAR(roundness({a, b, c, d}), 1.0, 1e-12);
        EXPECT_NEAR(roundness({a, c, b, d}), 1.0, 1e-12);
        EXPECT_NEAR(roundness({a, b, c, 0.5 * (a + b)}), 0.0, 1e-12);
    }
}

TEST(TetCheck, HasNothingToSayAboutAGoodMesh) {
    Notes notes;
    check_tets(kPair, notes);
    EXPECT_THAT(notes, IsEmpty());
}

TEST(TetCheck, NamesTheFlattestTet) {
    TetMesh mesh = kPair;
    mesh.positions[4].z = -1e-5;
    Notes notes;
    check_tets(mesh, notes);
    EXPECT_THAT(notes, ElementsAre(HasSubstr(": 1 (the flattest is tet 2, with 5e-06 of the volume")));
}

// Both tets on one side of their face: node 4 was moved through it.
TEST_F(TetFileTest, TellsOfTetsThatOverlap) {
    read("a.mesh", replaced(kMedit, "0.1 0.2 -0.3333333333333333", "0.1 0.2 0.6"));
    EXPECT_THAT(notes_,
                ElementsAre("flipped inverted tets: 1",
                            "tets that overlap a neighbour, as in a tangled mesh: 1 pair (the first is "
                            "tets 1 and 2)"));
}

TEST_F(TetFileTest, TellsOfFacesOfMoreThanTwoTets) {
    const std::string medit = replaced(replaced(kMedit, "Vertices\n5\n", "Vertices\n6\n"), "Tetrahedra\n2\n",
                                       "Tetrahedra\n3\n1 2 3 6 1\n");
    read("a.mesh", replaced(medit, "-0.3333333333333333 7\n", "-0.3333333333333333 7\n0.3 0.3 2 0\n"));
    EXPECT_THAT(notes_, ElementsAre("faces of more than two tets: 1"));
}

// Each tet with four nodes of its own.
TEST_F(TetFileTest, MergesNodesThatCoincide) {
    const TetMesh mesh =
        read("a.mesh",
             "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
             "0 0 0 0\n0 1 0 0\n1 0 0 0\n0.1 0.2 -0.3333333333333333 0\n"
             "Tetrahedra\n2\n1 2 3 4 0\n5 6 7 8 0\nEnd\n");
    EXPECT_THAT(notes_, ElementsAre("merged nodes that coincide: 3"));
    EXPECT_EQ(mesh.positions, kPair.positions);
    EXPECT_EQ(mesh.tets, kPair.tets);
    EXPECT_EQ(mesh.faces.size(), 6u);
}

// Attributes

TEST_F(TetFileTest, ReadsAttributesOfEveryFormat) {
    read_tetgen("5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0.1 0.2 -0.3333333333333333\n",
                "2 4 2\n0 0 1 2 3 17.0 5\n1 0 2 1 4 -3 5\n");
    EXPECT_THAT(read_tets(path("a.node"), notes_).attributes, ElementsAre(17, -3));
    EXPECT_THAT(read("a.mesh", replaced(kMedit, "1 3 2 5 1", "1 3 2 5 -2")).attributes, ElementsAre(1, -2));
    EXPECT_THAT(read("a.msh", replaced(kGmsh2, "2 4 0 10", "2 4 2 4 9 10")).attributes, ElementsAre(1, 4));
    EXPECT_THAT(read("a.msh", binary_gmsh2(true)).attributes, ElementsAre(1, 1));
    // Two volumes, of groups 6 (turned) and 8 and 9, and points, a curve and a surface that are of others.
    const std::string entities =
        "1 1 1 2\n5 0 0 0 1 30\n7 0 0 0 1 1 1 0 2 5 -5\n1 0 0 0 1 1 1 1 31 1 7\n"
        "1 0 0 0 1 1 1 1 -6 1 1\n2 0 0 0 1 1 1 2 8 9 1 -1\n";
    const std::string two = replaced(kGmsh4, "1 2 1 2\n3 1 4 2\n1 10 20 30 5\n2 10 30 20 77\n",
                                     "2 2 1 2\n3 2 4 1\n1 10 20 30 5\n3 1 4 1\n2 10 30 20 77\n");
    EXPECT_THAT(read("a.msh", replaced(two, "0 0 0 1\n1 0 0 0 1 1 1 0 0\n", entities)).attributes,
                ElementsAre(8, 6));
}

TEST_F(TetFileTest, HasNoAttributesWhereAllAreZeroOrNotWhole) {
    EXPECT_THAT(
        read("a.mesh", replaced(replaced(kMedit, "1 2 3 4 1", "1 2 3 4 0"), "3 2 5 1", "3 2 5 0")).attributes,
        IsEmpty());
    EXPECT_THAT(read("a.msh", kGmsh4).attributes, IsEmpty());
    EXPECT_THAT(notes_, IsEmpty());
    const std::string nodes = "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0.1 0.2 -0.3333333333333333\n";
    EXPECT_THAT(read_tetgen(nodes, "2 4 1\n0 0 1 2 3 0.5\n1 0 2 1 4 2\n").attributes, IsEmpty());
    EXPECT_THAT(notes_, ElementsAre("ignored attributes of tets that are not integers"));
}

TEST_F(TetFileTest, AttributesStayWithTheirTets) {
    const std::string twice = replaced(kMedit, "Tetrahedra\n2\n1 2 3 4 1\n1 3 2 5 1\n",
                                       "Tetrahedra\n4\n1 2 3 4 5\n2 3 4 1 6\n1 3 2 5 7\n3 2 5 1 8\n");
    TetMesh mesh = read("a.mesh", twice);
    EXPECT_THAT(notes_, testing::Contains("discarded duplicate tets: 2"));
    EXPECT_THAT(mesh.attributes, ElementsAre(5, 7));
    for (const char* name : {"b.node", "b.mesh", "b.msh"}) {
        write_tets(path(name), mesh);
        const TetMesh again = read_tets(path(name), notes_);
        for (std::size_t t = 0; t < 2; ++t) {  // Gmsh's go by group
            const bool is_first = again.tets[t] == mesh.tets[0];
            EXPECT_EQ(again.attributes[t], is_first ? 5 : 7) << name;
        }
    }
    write_tets(path("b.vtu"), mesh);
    EXPECT_THAT(read_file(path("b.vtu")),
                HasSubstr("Name=\"attribute\" format=\"ascii\">\n5\n7\n</DataArray>"));
}

}  // namespace
}  // namespace gelatin
