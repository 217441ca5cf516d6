#include "model/springs/springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "mesh/topology.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

double sum_k_l2(const std::vector<Spring>& springs) {
    double sum = 0.0;
    for (const Spring& s : springs)
        sum += static_cast<double>(s.stiffness) * std::pow(static_cast<double>(s.rest_length), 2);
    return sum;
}

std::set<std::pair<unsigned, unsigned>> pairs_of(const std::vector<Spring>& springs) {
    std::set<std::pair<unsigned, unsigned>> pairs;
    for (const Spring& s : springs) pairs.emplace(s.i, s.j);
    return pairs;
}

TetMesh tall_tet() {
    TetMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}};
    mesh.tets = {{0, 1, 2, 3}};
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

// Two tets over the triangle 0 1 2, with corners 3 above and 4 below.
TetMesh two_tets() {
    TetMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}, {0.3, 0.3, -1}};
    mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    mesh.faces = boundary_faces(mesh.tets);
    return mesh;
}

// Van Gelder: k = E V / l^2; the tet's volume is 2 * 1 * 3 / 6 = 1.
TEST(Springs, StructuralStiffnessIsVanGelders) {
    const std::vector<Spring> springs = make_springs(tall_tet(), {true, false, false}, 7e4);
    ASSERT_EQ(springs.size(), 6u);
    EXPECT_EQ(springs[0].i, 0u);
    EXPECT_EQ(springs[0].j, 1u);
    EXPECT_FLOAT_EQ(springs[0].rest_length, 2.0f);
    EXPECT_FLOAT_EQ(springs[0].stiffness, 7e4f / 4.0f);
    EXPECT_FLOAT_EQ(springs[2].rest_length, 3.0f);
    EXPECT_FLOAT_EQ(springs[2].stiffness, 7e4f / 9.0f);
}

TEST(Springs, ShearJoinsTheCornersAcrossASharedFace) {
    const auto pairs = pairs_of(make_springs(two_tets(), {true, true, false}, 1.0));
    EXPECT_EQ(pairs.size(), 10u);
    EXPECT_TRUE(pairs.count({3, 4}));
}

// The block's boundary has edges whose opposite corners are joined by no tet edge; they must come with flex.
TEST(Springs, FlexJoinsCornersAcrossSurfaceEdgesAndGoesStraightInside) {
    const TetMesh mesh = test::make_block({4, 4, 4}, {1, 1, 1});
    const auto structural = pairs_of(make_springs(mesh, {true, false, false}, 1.0));
    const auto with_flex = pairs_of(make_springs(mesh, {true, false, true}, 1.0));
    for (const SurfaceEdge& edge : surface_edges(mesh.faces)) {
        const auto pair = std::minmax(edge.corners[0], edge.corners[1]);
        EXPECT_TRUE(with_flex.count(pair)) << pair.first << " " << pair.second;
    }
    std::size_t straight = 0;
    for (const auto& pair : with_flex) {
        if (structural.count(pair)) continue;
        const glm::dvec3 d = glm::abs(mesh.positions[pair.first] - mesh.positions[pair.second]) * 4.0;
        straight += glm::distance(d, glm::dvec3(2, 0, 0)) < 1e-9 ? 1 : 0;  // two cells along x
    }
    EXPECT_GT(straight, 0u);
}

// Uniform dilation by e: the springs' 1/2 sum k (e l)^2 is the continuum's 9/2 K e^2 V at Poisson's ratio
// 1/4, that is sum k l^2 = 6 E V, whatever the kinds and the mesh.
class SpringKindsTest : public ::testing::TestWithParam<SpringKinds> {};
TEST_P(SpringKindsTest, KeepTheEnergyOfDilation) {
    const TetMesh mesh = test::make_block({5, 3, 4}, {1.0, 0.7, 0.9}, 0.25);
    const double youngs_modulus = 3e5;
    const std::vector<Spring> springs = make_springs(mesh, GetParam(), youngs_modulus);
    EXPECT_NEAR(sum_k_l2(springs) / (6.0 * youngs_modulus * total_volume(mesh)), 1.0, 1e-6);
    EXPECT_EQ(pairs_of(springs).size(), springs.size()) << "a pair has more than one spring";
    for (const Spring& s : springs) {
        EXPECT_LT(s.i, s.j);
        EXPECT_GT(s.stiffness, 0.0f);
        EXPECT_FLOAT_EQ(s.rest_length,
                        static_cast<float>(glm::distance(mesh.positions[s.i], mesh.positions[s.j])));
    }
}
INSTANTIATE_TEST_SUITE_P(All, SpringKindsTest,
                         ::testing::Values(SpringKinds{true, false, false}, SpringKinds{true, true, false},
                                           SpringKinds{true, false, true}, SpringKinds{true, true, true},
                                           SpringKinds{false, true, true}));

}  // namespace
}  // namespace gelatin
