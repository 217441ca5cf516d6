#include "mesh/closed_pieces.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/topology.h"
#include "support/shells.h"

namespace gelatin {
namespace {

TetMesh tets_of(const Mesh& mesh) {
    TetMesh tets{mesh.vertices, mesh.tets, {}};
    tets.faces = boundary_faces(tets.tets);
    return tets;
}

double volume_of(const std::vector<glm::uvec3>& faces, const std::vector<glm::dvec3>& at) {
    double sum = 0.0;
    for (const glm::uvec3& f : faces) sum += glm::dot(at[f.x], glm::cross(at[f.y], at[f.z])) / 6.0;
    return sum;
}

TEST(ClosedPieces, OfAShellAreTwo) {
    const TetMesh shell = tets_of(*test::sphere_shell(0.5, 0.7, 3, 2));
    const auto pieces = find_closed_pieces(shell.faces);
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_EQ(pieces[0].size(), 180u);
    EXPECT_EQ(pieces[1].size(), 180u);
    EXPECT_TRUE(find_closed_pieces(std::span(shell.faces).first(1)).empty());
}

// Of two shells, and of none.
TEST(ClosedPieces, HollowsWindAroundWhatTheyEnclose) {
    const auto shell = test::sphere_shell(0.5, 0.7, 6, 1);
    const TetMesh both = tets_of(*test::joined(*shell, *shell, {2.0, 0.0, 0.0}));
    const auto hollows = find_hollows(both);
    ASSERT_EQ(hollows.size(), 2u);
    const double sphere = 4.0 / 3.0 * std::numbers::pi * 0.125;
    for (const auto& faces : hollows) {
        EXPECT_EQ(faces.size(), 720u);
        EXPECT_NEAR(volume_of(faces, both.positions), sphere, 0.03 * sphere);
    }
    TetMesh solid;
    solid.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    solid.tets = {{0, 1, 2, 3}};
    solid.faces = boundary_faces(solid.tets);
    EXPECT_TRUE(find_hollows(solid).empty());
}

}  // namespace
}  // namespace gelatin
