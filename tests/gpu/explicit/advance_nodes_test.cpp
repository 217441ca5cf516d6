#include "gpu/explicit/advance_nodes.h"

#include <gtest/gtest.h>

#include "gpu/explicit/divide_and_merge.h"
#include "gpu/support/solver_scenarios.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/parity.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 2e-4;  // [s]

struct Case {
    SolverKind solver;
    ForceMethod forces;
};

class StepParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, StepParityTest, ::testing::ValuesIn(test::step_scenarios()),
                         test::name_of_scenario);

// An irregular net with damping, pins, a floor and a sphere in the way, no multiple of 64 nodes, without
// loads and moving handles and with them: one step reproduces the double-precision reference within rounding,
// writes every node and nothing behind the last.
TEST_P(StepParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(StepParity, HasNodesBeyondTheLastFullGroup) {
    EXPECT_NE(test::make_lively_model().node_count() % 64, 0u);
    EXPECT_NE(test::make_driven_model().node_count() % 64, 0u);
}

class AdvanceNodesOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<Case> {};
INSTANTIATE_TEST_SUITE_P(All, AdvanceNodesOnGpuTest,
                         ::testing::Values(Case{SolverKind::explicit_euler, ForceMethod::fused},
                                           Case{SolverKind::semi_implicit_euler, ForceMethod::fused},
                                           Case{SolverKind::midpoint, ForceMethod::fused},
                                           Case{SolverKind::rk4, ForceMethod::fused},
                                           Case{SolverKind::explicit_euler, ForceMethod::divide_and_merge},
                                           Case{SolverKind::semi_implicit_euler,
                                                ForceMethod::divide_and_merge},
                                           Case{SolverKind::midpoint, ForceMethod::divide_and_merge},
                                           Case{SolverKind::rk4, ForceMethod::divide_and_merge}),
                         [](const auto& test) {
                             return std::string(name_of(test.param.solver)) +
                                    (test.param.forces == ForceMethod::fused ? "_fused"
                                                                             : "_divide_and_merge");
                         });

// Two nodes in one place, and a node without springs: finite, and as the reference has it.
TEST_P(AdvanceNodesOnGpuTest, SurvivesDegenerateSprings) {
    test::Net net;
    net.positions = {{0, 1, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 5}};
    net.velocities = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    net.masses = {1.0, 2.0, 3.0, 4.0};
    net.springs = {{0, 1, 0.5f, 100.0f}, {1, 2, 0.5f, 100.0f}};
    net.damping_time = 0.01;
    net.gravity = {0.0, -9.81, 0.0};
    const Model model = test::make_model(net);
    const test::NodeArrays actual = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    const cpu::Nodes<double> expected = test::oracle_step(model, GetParam().solver, kStep);
    for (std::uint32_t n = 0; n < 4; ++n) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(actual.positions[n][k], expected.positions[n][k], 2e-6);
            EXPECT_NEAR(actual.velocities[n][k], expected.velocities[n][k], 2e-5);
        }
    }
}

// Same build, device and start: the same bits.
TEST_P(AdvanceNodesOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_lively_model();
    const test::NodeArrays a = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    const test::NodeArrays b = test::step_on_gpu(model, GetParam().solver, GetParam().forces, kStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(a.positions[n], b.positions[n]);
        EXPECT_EQ(a.velocities[n], b.velocities[n]);
    }
}

}  // namespace
}  // namespace gelatin
