// Neo-Hookean tets on the GPU: explicit steps and energy against the double reference, with
// bodies of springs beside them, tets that are inside out, pins, and with damping or without.
#include <gtest/gtest.h>

#include "gpu/support/solver_scenarios.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/step_on_gpu.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

class NeoHookeanStepParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, NeoHookeanStepParityTest,
                         ::testing::ValuesIn(test::neo_hookean_step_scenarios()), test::name_of_scenario);

TEST_P(NeoHookeanStepParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class NeoHookeanEnergyParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, NeoHookeanEnergyParityTest,
                         ::testing::ValuesIn(test::neo_hookean_energy_scenarios()), test::name_of_scenario);

TEST_P(NeoHookeanEnergyParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class NeoHookeanOnGpuTest : public test::GlTest {};

TEST_F(NeoHookeanOnGpuTest, StepsRepeatBitForBit) {
    const Model model = test::make_lively_tets(2e-3);
    ASSERT_NE(model.node_count() % 64, 0u);
    for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
        const test::NodeArrays one = test::step_on_gpu(model, SolverKind::rk4, forces, 2e-4),
                               two = test::step_on_gpu(model, SolverKind::rk4, forces, 2e-4);
        for (std::uint32_t n = 0; n < model.node_count(); ++n)
            EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

}  // namespace
}  // namespace gelatin
