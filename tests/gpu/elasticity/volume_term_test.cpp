// The volume term of explicit steps on the GPU against the double reference, on bodies in motion whose tets
// are partly inside out, below and above 1/4, with pins, colliders, and neo-Hookean bodies beside.
#include "model/elasticity/volume_term.h"

#include <gtest/gtest.h>

#include "gpu/support/solver_scenarios.h"
#include "model/setting_names.h"
#include "support/mixed_bodies.h"

namespace gelatin {
namespace {

class VolumeStepParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, VolumeStepParityTest, ::testing::ValuesIn(test::volume_step_scenarios()),
                         test::name_of_scenario);

TEST_P(VolumeStepParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class VolumeEnergyParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, VolumeEnergyParityTest, ::testing::ValuesIn(test::volume_energy_scenarios()),
                         test::name_of_scenario);

TEST_P(VolumeEnergyParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(VolumeTermOnGpu, HasNodesBeyondTheLastFullGroup) {
    for (const double poisson_ratio : {0.0, 0.45}) {
        const Model model = test::make_mixed_bodies(2e-3, poisson_ratio);
        EXPECT_NE(model.node_count() % 64, 0u);
        EXPECT_FALSE(model.volume_term.is_empty());
    }
}

}  // namespace
}  // namespace gelatin
