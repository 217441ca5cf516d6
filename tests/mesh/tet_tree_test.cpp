#include "mesh/tet_tree.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "support/random_maker.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

double least_of(const glm::dvec4& w) {
    return std::min(std::min(w.x, w.y), std::min(w.z, w.w));
}

// The least weight of the point in any tet that is not flat: negative outside all.
double deepest_of_all(const TetMesh& mesh, const glm::dvec3& p) {
    double deepest = -1e300;
    for (const glm::uvec4& tet : mesh.tets) deepest = std::max(deepest, least_of(barycentric(mesh, tet, p)));
    return deepest;
}

glm::dvec3 point_of(const TetMesh& mesh, const TetPoint& found) {
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k) sum += found.weights[k] * mesh.positions[mesh.tets[found.tet][k]];
    return sum;
}

TEST(TetTree, FindsTheTetThatContainsAPoint) {
    const TetMesh mesh = test::make_block({5, 4, 3}, {1.0, 0.8, 0.6}, 0.3);
    const TetTree tree(mesh);
    test::RandomMaker random(3);
    int inside = 0;
    for (int k = 0; k < 2000; ++k) {
        const glm::dvec3 p(random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.0), random.uniform(-0.2, 0.8));
        const auto found = tree.find(p);
        const double deepest = deepest_of_all(mesh, p);
        ASSERT_EQ(found.has_value(), deepest > -1e-9);
        if (!found) continue;
        ++inside;
        EXPECT_EQ(least_of(found->weights), deepest);
        EXPECT_LT(glm::distance(point_of(mesh, *found), p), 1e-14);
    }
    EXPECT_GT(inside, 500);
}

TEST(TetTree, FindsNodesAndPointsOfFacesInSpiteOfRounding) {
    TetMesh mesh = test::make_block({3, 3, 3}, {0.1, 0.1, 0.1}, 0.2);
    for (glm::dvec3& p : mesh.positions) p += glm::dvec3(1000.1, -300.7, 77.3);
    const TetTree tree(mesh);
    for (const glm::dvec3& p : mesh.positions) EXPECT_TRUE(tree.find(p));
    for (const glm::uvec3& f : mesh.faces)
        EXPECT_TRUE(tree.find((mesh.positions[f.x] + mesh.positions[f.y] + mesh.positions[f.z]) / 3.0));
}

TEST(TetTree, OfSeveralTetsWithThePointTheFirstIsFound) {
    const TetMesh mesh = test::make_block({2, 2, 2}, {1.0, 1.0, 1.0});
    const TetTree tree(mesh);
    const glm::dvec3 middle(0.5);
    std::uint32_t first = 0;
    while (least_of(barycentric(mesh, mesh.tets[first], middle)) < 0.0) ++first;
    const auto found = tree.find(middle);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->tet, first);
}

TEST(TetTree, IgnoresFlatTetsAndIsEmptyWithoutTets) {
    const TetMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2, 3}}, {}};
    EXPECT_FALSE(TetTree(flat).find({0.3, 0.3, 0.0}));
    const TetMesh none;
    EXPECT_FALSE(TetTree(none).find({0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace gelatin
