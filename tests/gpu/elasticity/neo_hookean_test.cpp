// Neo-Hookean tets on the GPU: explicit steps, block descent and energy against the double reference, with
// bodies of springs beside them, tets that are inside out, pins, and with damping or without.
#include <gtest/gtest.h>

#include "model/setting_names.h"
#include "support/descend_on_gpu.h"
#include "support/gl_fixture.h"
#include "support/measure_on_gpu.h"
#include "support/parity.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 2e-4;  // [s]

struct Case {
    SolverKind solver;
    ForceMethod forces;
    double damping;  // [s]
};

class NeoHookeanStepOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<Case> {};
INSTANTIATE_TEST_SUITE_P(All, NeoHookeanStepOnGpuTest,
                         ::testing::Values(Case{SolverKind::semi_implicit_euler, ForceMethod::fused, 0.0},
                                           Case{SolverKind::semi_implicit_euler, ForceMethod::fused, 2e-3},
                                           Case{SolverKind::rk4, ForceMethod::fused, 2e-3},
                                           Case{SolverKind::semi_implicit_euler,
                                                ForceMethod::divide_and_merge, 0.0},
                                           Case{SolverKind::rk4, ForceMethod::divide_and_merge, 2e-3}),
                         [](const auto& test) {
                             return std::string(name_of(test.param.solver)) +
                                    (test.param.forces == ForceMethod::fused ? "_fused"
                                                                             : "_divide_and_merge") +
                                    (test.param.damping > 0.0 ? "_damped" : "");
                         });

TEST_P(NeoHookeanStepOnGpuTest, MatchesTheDoubleReference) {
    const Model model = test::make_lively_tets(GetParam().damping);
    ASSERT_NE(model.node_count() % 64, 0u);
    const test::NodeArrays actual = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    EXPECT_LE(test::worst_error(model, test::rounding_bounds(model, GetParam().solver, kStep),
                                test::oracle_step(model, GetParam().solver, kStep), actual.positions,
                                actual.velocities),
              1.0);
    EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
    EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
    const test::NodeArrays again = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        EXPECT_EQ(again.velocities[n], actual.velocities[n]);
}

class NeoHookeanOnGpuTest : public test::GlTest {};

TEST_F(NeoHookeanOnGpuTest, DescentMatchesTheDoubleReference) {
    for (const double damping : {0.0, 0.01}) {
        const Model model = test::make_bodies_to_descend(damping, 0.45, MaterialModel::neo_hookean);
        ASSERT_NE(model.node_count() % 64, 0u);
        for (const double step : {1e-3, 1.0 / 60.0}) {
            for (const int iterations : {1, 2, 3, 10}) {
                const test::NodeArrays actual = test::descend_on_gpu(model, {step, {iterations}});
                EXPECT_LE(test::worst_descent_error(model, {step, {iterations}}, actual), 1.0)
                    << damping << " s, " << step << " s, " << iterations << " sweeps";
                EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
            }
        }
    }
}

TEST_F(NeoHookeanOnGpuTest, APointOpensAsOnTheCpu) {
    Model model = test::make_bodies_to_descend(0.0, 0.3, MaterialModel::neo_hookean);
    const Range& nodes = model.objects[2].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const float inverse_mass = model.positions[n].w;
        model.positions[n] = glm::vec4(0.0f, 1.0f, 1.0f, inverse_mass);
    }
    const test::NodeArrays actual = test::descend_on_gpu(model, {1.0 / 60.0, {1}});
    EXPECT_LE(test::worst_descent_error(model, {1.0 / 60.0, {1}}, actual), 1.0);
    double moved = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        moved = std::max(moved, std::abs(static_cast<double>(actual.positions[n].x)));
    EXPECT_GT(moved, 1e-3);
}

TEST_F(NeoHookeanOnGpuTest, EnergyMatchesTheDoubleReference) {
    EXPECT_LE(test::worst_energy_error(test::make_lively_tets(0.0),
                                       test::measure_on_gpu(test::make_lively_tets(0.0))),
              1.0);
    Material material;
    material.model = MaterialModel::neo_hookean;
    const Model rest =
        test::make_model(test::make_body(test::make_block({5, 5, 5}, {1, 1, 1}, 0.2), material));
    EXPECT_LE(test::worst_energy_error(rest, test::measure_on_gpu(rest)), 1.0);
}

}  // namespace
}  // namespace gelatin
