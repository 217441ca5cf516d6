#include "model/springs/spring_moduli.h"

#include <gtest/gtest.h>

#include "mesh/topology.h"
#include "model/springs/fit_springs.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Two tets of volumes 1/6 and 1/3 on the face 0 1 2.
TetMesh pair_of_tets() {
    TetMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}};
    mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    return mesh;
}

TEST(SpringModuli, EdgesHaveTheMeanOfTheirTets) {
    const auto moduli = spring_moduli(pair_of_tets(), {1000.0, 40.0}, {{0, 1}, {0, 3}, {2, 4}});
    EXPECT_NEAR(moduli[0], (1000.0 + 2 * 40.0) / 3.0, 1e-9);
    EXPECT_NEAR(moduli[1], 1000.0, 1e-9);
    EXPECT_NEAR(moduli[2], 40.0, 1e-9);
}

TEST(SpringModuli, LinksAcrossAFaceHaveTheMeanCompliance) {
    const auto moduli = spring_moduli(pair_of_tets(), {1000.0, 40.0}, {{3, 4}});
    EXPECT_NEAR(1.0 / moduli[0], (1.0 / 1000.0 + 2.0 / 40.0) / 3.0, 1e-12);
}

TEST(SpringModuli, LinksAcrossASurfaceEdgeGoByTheTetsRoundIt) {
    TetMesh mesh;  // a fan of three tets round the edge 0 1, from corner 2 to corner 5
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}};
    mesh.tets = {{0, 2, 3, 1}, {0, 3, 4, 1}, {0, 4, 5, 1}};
    mesh.faces = boundary_faces(mesh.tets);
    const auto moduli = spring_moduli(mesh, {10.0, 20.0, 40.0}, {{2, 5}});
    EXPECT_NEAR(1.0 / moduli[0], (1.0 / 10.0 + 1.0 / 20.0 + 1.0 / 40.0) / 3.0, 1e-12);
}

// Four cubes in a row; what spans more than two goes by the tets at its ends.
TEST(SpringModuli, LongSpringsGoByTheTetsAtTheirEnds) {
    const TetMesh mesh = test::make_block({4, 1, 1}, {4, 1, 1});
    std::vector<double> tet_moduli(mesh.tets.size(), 10.0);
    for (std::size_t t = 12; t < 24; ++t) tet_moduli[t] = 30.0;
    const auto moduli = spring_moduli(mesh, tet_moduli, {{0, 1}, {0, 4}, {1, 3}});
    EXPECT_NEAR(moduli[0], 10.0, 1e-9);
    EXPECT_GT(moduli[1], 10.0);  // 0 is soft, 4 is stiff
    EXPECT_LT(moduli[1], 30.0);
    EXPECT_NEAR(moduli[2], 15.0, 1e-9);  // as much soft as stiff: 2 / (1/10 + 1/30)
}

TEST(SpringModuli, OneMaterialIsOneModulus) {
    const TetMesh mesh = test::make_block({3, 3, 3}, {1, 1, 1}, 0.2);
    std::vector<glm::uvec2> nodes;
    for (const UnitSpring& spring : fit_springs(mesh).springs) nodes.push_back(spring.nodes);
    for (const double modulus : spring_moduli(mesh, std::vector<double>(mesh.tets.size(), 5e4), nodes))
        EXPECT_NEAR(modulus, 5e4, 1e-6);
}

}  // namespace
}  // namespace gelatin
