#include "mesh/lattice/face_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "support/draw_vector.h"

namespace gelatin::lattice {
namespace {

TEST(FaceTreeTest, FindsWhereASegmentCrosses) {
    SurfaceMesh surface = cube({0.0, 0.0, 0.0}, 1.0);
    append(surface, cube({2.0, 0.0, 0.0}, 1.0));
    const FaceTree tree(surface);
    std::vector<Crossing> found;
    tree.find_crossings({-1.0, 0.3, 0.4}, {4.0, 0.3, 0.4}, found);
    ASSERT_EQ(found.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k].at, 0.2 * static_cast<double>(k + 1), 1e-14);
    tree.find_crossings({-1.0, 1.3, 0.4}, {4.0, 1.3, 0.4}, found);
    EXPECT_TRUE(found.empty());
}

TEST(FaceTreeTest, FindsTheNearestPoint) {
    const SurfaceMesh surface = make_sphere({0.5, 9});
    const FaceTree tree(surface);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> along(-1.0, 1.0);
    for (int k = 0; k < 300; ++k) {
        const auto p = test::draw_vector<glm::dvec3>(along, random);
        double least = std::numeric_limits<double>::infinity();
        for (const Triangle& face : tree.faces())
            least = std::min(least, glm::distance(p, nearest_point(face, p)));
        const auto nearest = tree.find_nearest(p, 2.0);
        ASSERT_TRUE(nearest);
        EXPECT_NEAR(glm::distance(p, nearest->point), least, 1e-15);
        EXPECT_FALSE(tree.find_nearest(p, 0.999 * least));
    }
}

TEST(FaceTreeTest, TheNearestPointOfAFaceIsInsideOnAnEdgeOrACorner) {
    const Triangle face = {glm::dvec3(0, 0, 0), glm::dvec3(2, 0, 0), glm::dvec3(0, 2, 0)};
    EXPECT_EQ(nearest_point(face, {0.5, 0.5, 3.0}), glm::dvec3(0.5, 0.5, 0.0));
    EXPECT_EQ(nearest_point(face, {1.0, -1.0, 1.0}), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(nearest_point(face, {2.0, 2.0, 1.0}), glm::dvec3(1.0, 1.0, 0.0));
    EXPECT_EQ(nearest_point(face, {5.0, -1.0, 1.0}), glm::dvec3(2.0, 0.0, 0.0));
}

}  // namespace
}  // namespace gelatin::lattice
