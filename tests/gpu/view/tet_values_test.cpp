#include "gpu/view/tet_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <numeric>

#include "gpu/support/solver_scenarios.h"
#include "gpu/support/tet_values.h"
#include "gpu/view/tet_values.h"
#include "mesh/shapes.h"
#include "model/assembly/rigid_body.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class TetValueParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, TetValueParityTest, ::testing::ValuesIn(test::tet_value_scenarios()),
                         test::name_of_scenario);

TEST_P(TetValueParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(TetValues, HasTetsAndNodesBeyondTheLastFullGroup) {
    const test::Deformed bodies = test::make_deformed();
    EXPECT_NE(bodies.model.tets.size() % 64, 0u);
    EXPECT_NE(bodies.model.node_count() % 64, 0u);
}

// A block of E = 2e5 Pa and a Poisson's ratio of 0.3, of this deformation gradient and then turned.
test::Deformed make_uniform(const glm::dmat3& gradient) {
    Material material = test::structural_material();
    material.youngs_modulus = 2e5;
    material.poisson_ratio = 0.3;
    test::Deformed body{.model = test::make_model(
                            test::make_body(test::make_block({3, 3, 3}, {0.6, 0.6, 0.6}, 0.2), material)),
                        .positions = {},
                        .velocities = {}};
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.8, glm::normalize(glm::dvec3(1.0, 2.0, -1.0))));
    for (const glm::vec4& rest : body.model.positions) {
        body.positions.emplace_back(glm::vec3(turn * gradient * glm::dvec3(rest)), rest.w);
        body.velocities.emplace_back(3.0f, 4.0f, 12.0f, 0.0f);
    }
    return body;
}

class TetValuesOfClosedForms : public test::GlTest {
protected:
    // Every tet and every node has it.
    static void expect_everywhere(const test::Deformed& body, Quantity quantity, double value) {
        const test::GpuValues actual = test::values_on_gpu(body, quantity);
        for (const float v : actual.tets) EXPECT_NEAR(v, value, 1e-4 * value + 1e-9);
        for (const float v : actual.nodes) EXPECT_NEAR(v, value, 1e-4 * value + 1e-9);
    }
};

TEST_F(TetValuesOfClosedForms, PullingInOneDirectionHasHookesStress) {
    constexpr double kStrain = 0.02;
    const glm::dvec3 stretches(1.0 + kStrain, 1.0 - 0.3 * kStrain, 1.0 - 0.3 * kStrain);
    const test::Deformed body = make_uniform(
        {glm::dvec3(stretches.x, 0, 0), glm::dvec3(0, stretches.y, 0), glm::dvec3(0, 0, stretches.z)});
    expect_everywhere(body, Quantity::stress, 2e5 * kStrain);
    expect_everywhere(body, Quantity::stretch, 1.0 + kStrain);
    expect_everywhere(body, Quantity::speed, 13.0);
}

// Shear by g: principal stretches differ by g, and so von Mises' stress is that of pure shear, sqrt(3) mu g,
// to first order.
TEST_F(TetValuesOfClosedForms, ShearHasThreesRootOfItsStress) {
    constexpr double kShear = 1e-3, kMu = 2e5 / 2.6;
    const test::Deformed body =
        make_uniform({glm::dvec3(1, 0, 0), glm::dvec3(kShear, 1, 0), glm::dvec3(0, 0, 1)});
    const test::GpuValues actual = test::values_on_gpu(body, Quantity::stress);
    for (const float v : actual.tets) EXPECT_NEAR(v, std::sqrt(3.0) * kMu * kShear, 2e-3 * kMu * kShear);
}

TEST_F(TetValuesOfClosedForms, PressureHasNoStressOfShape) {
    const test::Deformed body = make_uniform(glm::dmat3(0.9));
    for (const float v : test::values_on_gpu(body, Quantity::stress).tets) EXPECT_LT(v, 1e-5 * 2e5);
}

TEST_F(TetValuesOfClosedForms, AMirrorImageIsFarFromRest) {
    const test::Deformed body =
        make_uniform({glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)});
    expect_everywhere(body, Quantity::stress, 4.0 * 2e5 / 2.6);  // stretches 1, 1, -1
}

// They have no tets, which the range of colours would follow.
TEST_F(TetValuesOfClosedForms, SpeedsOfRigidBodiesAreCounted) {
    const SurfaceMesh surface = make_box({glm::dvec3(1.0), glm::ivec3(2)});
    Body body = test::make_body(TetMesh{});
    RigidNodes nodes = make_rigid_nodes(surface, solid_moments(surface, 1e3));
    body.mesh = std::move(nodes.mesh);
    body.rigid_masses = std::move(nodes.masses);
    body.rigid_volume = 1.0;
    const Model model = test::make_model(body);
    const std::vector<glm::vec4> velocities(model.node_count(), glm::vec4(3.0f, 4.0f, 12.0f, 0.0f));
    gl::TexelTable<glm::vec4> positions(model.positions, gl::TexelFormat::rgba32f),
        speeds(velocities, gl::TexelFormat::rgba32f);
    for (const Quantity quantity : {Quantity::speed, Quantity::stretch}) {
        gpu::TetValues values(model, quantity);
        values.run(positions.texels(), speeds.texels());
        std::vector<std::uint32_t> counts(gpu::TetValues::kBins);
        values.histogram().download(counts);
        const bool is_counted = quantity == Quantity::speed;
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), is_counted ? model.node_count() : 0u);
        const std::size_t bin = std::bit_cast<std::uint32_t>(13.0f) >> gpu::TetValues::kBinShift;
        EXPECT_EQ(counts[bin], is_counted ? model.node_count() : 0u);
    }
}

}  // namespace
}  // namespace gelatin
