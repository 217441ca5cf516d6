// The system of a step on the GPU, solved, against the double reference: bodies that are free, and held.
#include "gpu/implicit/step_system.h"

#include <gtest/gtest.h>

#include <array>

#include "cpu/contact/tuning.h"
#include "gpu/support/implicit_scenarios.h"
#include "model/shared_constants.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class StepSystemParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, StepSystemParityTest,
                         ::testing::ValuesIn(test::joined({test::step_system_scenarios(),
                                                           test::small_island_scenarios(false),
                                                           test::small_island_scenarios(true)})),
                         test::name_of_scenario);

TEST_P(StepSystemParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

TEST(ContactTuning, IsThatOfTheCpu) {
    namespace gpu = contact_tuning;
    namespace cpu = cpu::tuning;
    EXPECT_EQ(gpu::kLinearGap, static_cast<float>(cpu::kLinearGap));
    EXPECT_EQ(gpu::kChordGap, static_cast<float>(cpu::kChordGap));
    EXPECT_EQ(gpu::kNearBalance, static_cast<float>(cpu::kNearBalance));
    EXPECT_EQ(gpu::kBalance, static_cast<float>(cpu::kBalance));
    EXPECT_EQ(gpu::kTurned, static_cast<float>(cpu::kTurned));
    EXPECT_EQ(gpu::kRigidForcing, static_cast<float>(cpu::kRigidForcing));
    EXPECT_EQ(gpu::kForcing, static_cast<float>(cpu::kForcing));
    EXPECT_EQ(gpu::kRestingFall, static_cast<float>(cpu::kRestingFall));
    EXPECT_EQ(gpu::kMostParts, static_cast<std::uint32_t>(cpu::kMostParts));
    EXPECT_EQ(gpu::kLeftOfFast, static_cast<float>(cpu::kLeftOfFast));
    EXPECT_EQ(gpu::kLeastOfReach, static_cast<float>(cpu::kLeastOfReach));
    EXPECT_EQ(gpu::kLeastOfGap, static_cast<float>(cpu::kLeastOfGap));
    EXPECT_EQ(gpu::kProjections, static_cast<std::uint32_t>(cpu::kProjections));
    EXPECT_EQ(gpu::kEnergyRounding, static_cast<float>(cpu::kEnergyRounding));
    EXPECT_EQ(gpu::kLeastEnergy, static_cast<float>(cpu::kLeastEnergy));
    EXPECT_EQ(gpu::kSlackOfEnergy, static_cast<float>(cpu::kSlackOfEnergy));
    EXPECT_EQ(gpu::kMostGain, static_cast<float>(cpu::kMostGain));
    EXPECT_EQ(gpu::kLeftOfApproach, static_cast<float>(cpu::kLeftOfApproach));
    EXPECT_EQ(gpu::kLongestImpact, static_cast<float>(cpu::kLongestImpact));
    EXPECT_EQ(gpu::kMostRounds, static_cast<std::uint32_t>(cpu::kMostRounds));
    EXPECT_EQ(gpu::kMostRigidIterations, static_cast<std::uint32_t>(cpu::kMostRigidIterations));
    EXPECT_EQ(gpu::kMostLinearisations, static_cast<std::uint32_t>(cpu::kMostLinearisations));
    EXPECT_EQ(gpu::kFrame, static_cast<float>(cpu::kFrame));
    EXPECT_EQ(gpu::kRestingTime, static_cast<float>(cpu::kRestingTime));
    EXPECT_EQ(gpu::kSleepTime, static_cast<float>(cpu::kSleepTime));
    EXPECT_EQ(gpu::kSleepPlace, static_cast<float>(cpu::kSleepPlace));
    EXPECT_EQ((std::array{gpu::kPartsOfMoving, gpu::kPartsOfCalm, gpu::kPartsOfStill}), cpu::kParts);
    EXPECT_EQ(gpu::kLeastReach, static_cast<float>(cpu::kLeastReach));
    EXPECT_EQ(gpu::kEasing, static_cast<float>(cpu::kEasing));
    EXPECT_EQ(gpu::kPushing, static_cast<float>(cpu::kPushing));
    EXPECT_EQ(gpu::kOfRestGap, static_cast<float>(cpu::kOfRestGap));
    EXPECT_EQ(gpu::kSoftened, static_cast<float>(cpu::kSoftened));
    EXPECT_EQ(gpu::kOnEdge, static_cast<float>(cpu::kOnEdge));
    EXPECT_EQ(gpu::kPathSlack, static_cast<float>(cpu::kPathSlack));
    EXPECT_EQ(gpu::kIdleGap, static_cast<float>(cpu::kIdleGap));
    EXPECT_EQ(gpu::kDeepest, static_cast<float>(cpu::kDeepest));
    EXPECT_EQ(gpu::kFastest, static_cast<float>(cpu::kFastest));
    EXPECT_EQ(gpu::kTolerance, static_cast<float>(cpu::kTolerance));
    EXPECT_EQ(gpu::kAtRest, static_cast<float>(cpu::kAtRest));
    EXPECT_EQ(gpu::kInIsland, static_cast<float>(cpu::kInIsland));
    EXPECT_EQ(gpu::kKept, static_cast<float>(cpu::kKept));
    EXPECT_EQ(gpu::kLeastOfRounding, static_cast<float>(cpu::kLeastOfRounding));
    EXPECT_EQ(gpu::kUsable, static_cast<float>(cpu::kUsable));
    EXPECT_EQ(gpu::kLeastShare, static_cast<float>(cpu::kLeastShare));
    EXPECT_EQ(gpu::kShortestPiece, static_cast<float>(cpu::kShortestPiece));
    EXPECT_EQ(gpu::kRoundings, static_cast<float>(cpu::kRoundings));
}

class StepSystemOnGpuTest : public test::GlTest {};

TEST_F(StepSystemOnGpuTest, RepeatsBitForBit) {
    EXPECT_TRUE(test::solves_repeat());
}

}  // namespace
}  // namespace gelatin
