#include "mesh/flat_tets.h"

#include <gtest/gtest.h>

#include "mesh/surface_repair.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

// A pyramid on the unit square (nodes 0 to 3, apex 4) of two tets, and below its square a tet without height.
TetMesh make_pyramid_with_flat_base() {
    TetMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
    mesh.tets = {{0, 1, 2, 4}, {0, 1, 2, 3}, {0, 2, 3, 4}};
    return mesh;
}

double volume(const TetMesh& mesh) {
    return signed_volume({mesh.positions, boundary_faces(mesh.tets)});
}

TEST(FlatTets, FlatnessDoesNotDependOnSizeOrSign) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        TetMesh mesh{
            {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}, {size, size, 1e-14 * size}}, {}, {}};
        EXPECT_FALSE(is_flat(mesh, {0, 1, 2, 3}));
        EXPECT_FALSE(is_flat(mesh, {0, 2, 1, 3}));
        EXPECT_TRUE(is_flat(mesh, {0, 1, 2, 4}));
        EXPECT_TRUE(is_flat(mesh, {0, 2, 1, 4}));
        EXPECT_TRUE(is_flat(mesh, {0, 0, 0, 0}));
    }
}

TEST(FlatTets, AreDroppedFromTheBoundary) {
    TetMesh mesh = make_pyramid_with_flat_base();
    EXPECT_EQ(drop_flat_skin(mesh), 0u);
    ASSERT_EQ(mesh.tets.size(), 2u);
    EXPECT_EQ(mesh.tets[0], glm::uvec4(0, 1, 2, 4));
    EXPECT_EQ(mesh.tets[1], glm::uvec4(0, 2, 3, 4));
    EXPECT_TRUE(measure_openness({mesh.positions, boundary_faces(mesh.tets)}).is_closed());
    EXPECT_DOUBLE_EQ(volume(mesh), 1.0 / 3.0);
}

// Below the flat base lies another, which comes to lie on the boundary with a second face when the first is
// gone.
TEST(FlatTets, AreDroppedOneAfterTheOther) {
    TetMesh mesh = make_pyramid_with_flat_base();
    mesh.positions.insert(mesh.positions.end(), {{0.25, 0.25, 0}, {0.5, 0.5, -1}});
    mesh.tets.insert(mesh.tets.end(), {{0, 1, 3, 5}, {0, 1, 5, 6}, {0, 3, 5, 6}});
    EXPECT_EQ(drop_flat_skin(mesh), 0u);
    EXPECT_EQ(mesh.tets.size(), 4u);
}

TEST(FlatTets, StayWhereANodeWouldLoseItsOnlyTet) {
    TetMesh mesh = make_pyramid_with_flat_base();
    mesh.tets.erase(mesh.tets.begin() + 1);
    mesh.positions.emplace_back(0.6, 0.3, 0);
    mesh.tets.emplace_back(0, 1, 2, 5);
    EXPECT_EQ(drop_flat_skin(mesh), 1u);
    EXPECT_EQ(mesh.tets.size(), 3u);
}

TEST(FlatTets, InsideAreLeftAndCounted) {
    TetMesh mesh = make_pyramid_with_flat_base();
    mesh.positions.emplace_back(0.5, 0.5, -1);  // a second pyramid below, with the other diagonal
    mesh.tets.emplace_back(0, 3, 1, 5);
    mesh.tets.emplace_back(1, 3, 2, 5);
    EXPECT_EQ(drop_flat_skin(mesh), 1u);
    EXPECT_EQ(mesh.tets.size(), 5u);
}

}  // namespace
}  // namespace gelatin
