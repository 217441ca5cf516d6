// Kernels broken on purpose must be caught: with each mutant of tests/mutants/ in place of the true shader,
// at least one of the scenarios that the tests of parity run must fail.
#include "gpu/support/mutants.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <span>

#include "gpu/support/collision_scenarios.h"
#include "gpu/support/implicit_scenarios.h"
#include "gpu/support/pair_guard_scenarios.h"
#include "gpu/support/pair_rows_scenarios.h"
#include "gpu/support/pair_scenarios.h"
#include "gpu/support/part_end_scenarios.h"
#include "gpu/support/part_start_scenarios.h"
#include "gpu/support/solver_scenarios.h"
#include "mutants/collision_mutants.h"
#include "mutants/guard_mutants.h"
#include "mutants/implicit_mutants.h"
#include "mutants/pair_mutants.h"
#include "mutants/solver_mutants.h"

namespace gelatin::test {
namespace {

void expect_is_caught(const MutantCase& at) {
    const BrokenShader broken(at.mutant);
    EXPECT_TRUE(std::any_of(at.scenarios.begin(), at.scenarios.end(),
                            [](const Scenario& scenario) { return !(scenario.error() <= 1.0); }))
        << "all " << at.scenarios.size() << " scenarios pass with the broken kernel";
}

TEST_P(MutantsTest, IsCaught) {
    expect_is_caught(GetParam());
}

class MutantsLong : public MutantsTest {};

TEST_P(MutantsLong, IsCaught) {
    expect_is_caught(GetParam());
}
INSTANTIATE_TEST_SUITE_P(StepRows, MutantsLong,
                         ::testing::ValuesIn(cases(kStepRowMutants, step_system_scenarios())), name_of_case);
INSTANTIATE_TEST_SUITE_P(SmallIslandRows, MutantsLong,
                         ::testing::ValuesIn(cases(kSmallIslandRowMutants, small_island_scenarios(true))),
                         name_of_case);

INSTANTIATE_TEST_SUITE_P(PartStarts, MutantsLong,
                         ::testing::ValuesIn(cases(kPartStartMutants, part_start_scenarios())), name_of_case);
INSTANTIATE_TEST_SUITE_P(FindPairs, MutantsLong,
                         ::testing::ValuesIn(cases(kFindPairsMutants, pair_scenarios())), name_of_case);
INSTANTIATE_TEST_SUITE_P(PairRows, MutantsLong,
                         ::testing::ValuesIn(cases(kPairRowMutants, pair_rows_scenarios())), name_of_case);
INSTANTIATE_TEST_SUITE_P(PairGuards, MutantsLong,
                         ::testing::ValuesIn(cases(kPairGuardMutants, pair_guard_scenarios())), name_of_case);
INSTANTIATE_TEST_SUITE_P(PartEnds, MutantsLong,
                         ::testing::ValuesIn(cases(kPartEndMutants, part_end_scenarios())), name_of_case);

#define INSTANTIATE_MUTANTS(name, mutants, scenarios) \
    INSTANTIATE_TEST_SUITE_P(name, MutantsTest, ::testing::ValuesIn(cases(mutants, scenarios)), name_of_case)

INSTANTIATE_MUTANTS(Steps, kStepMutants, step_scenarios());
INSTANTIATE_MUTANTS(Drive, kDriveMutants,
                    joined({kinematics_scenarios(), load_scenarios(), step_scenarios()}));
INSTANTIATE_MUTANTS(Pulls, kPullMutants, pull_scenarios());
INSTANTIATE_MUTANTS(ElasticSystem, kElasticSystemMutants, elastic_system_scenarios());
INSTANTIATE_MUTANTS(StepSystem, kStepSystemMutants, step_system_scenarios());
INSTANTIATE_MUTANTS(SmallIslands, kSmallIslandMutants, small_island_scenarios(false));
INSTANTIATE_MUTANTS(Matching, kMatchingMutants, matching_scenarios());
INSTANTIATE_MUTANTS(NeoHookean, kNeoHookeanMutants,
                    joined({neo_hookean_energy_scenarios(), neo_hookean_step_scenarios()}));
INSTANTIATE_MUTANTS(VolumeTerm, kVolumeTermMutants,
                    joined({volume_energy_scenarios(), volume_step_scenarios()}));
INSTANTIATE_MUTANTS(Watch, kWatchMutants, watch_scenarios());
INSTANTIATE_MUTANTS(CarrySkin, kCarrySkinMutants, carry_skin_scenarios());
INSTANTIATE_MUTANTS(TetValues, kTetValueMutants, tet_value_scenarios());
INSTANTIATE_MUTANTS(Collisions, kCollisionMutants, collision_scenarios());
INSTANTIATE_MUTANTS(ContinuousCollisions, kContinuousMutants, continuous_collision_scenarios());
INSTANTIATE_MUTANTS(Depth, kDepthMutants, joined({far_pair_scenarios(), collision_scenarios()}));
INSTANTIATE_MUTANTS(Responses, kResponseMutants, response_scenarios());
INSTANTIATE_MUTANTS(SelfCollisions, kSelfCollisionMutants,
                    joined({self_collision_scenarios(), calm_scenarios()}));
INSTANTIATE_MUTANTS(SelfResponses, kSelfResponseMutants, self_response_scenarios());
INSTANTIATE_MUTANTS(Proximities, kProximityMutants, proximity_scenarios());
INSTANTIATE_MUTANTS(Marks, kMarkMutants, mark_scenarios());

// A mutant that changes nothing, or something else than was meant, proves nothing.
TEST(BrokenShaderTest, RefusesTextThatDoesNotStandThereOnce) {
    const gl::ShaderOverride shader("some.comp", "one two two");
    const auto text_with = [](const char* from) {
        const BrokenShader broken({"name", "some.comp", from, "three"});
        return gl::shader_text("some.comp");
    };
    EXPECT_THROW(text_with("four"), std::runtime_error);
    EXPECT_THROW(text_with("two"), std::runtime_error);
}

// Those that only long tests try do not go out of date unseen.
TEST(BrokenShaderTest, FindsTheTextOfAllLongMutants) {
    for (const std::span<const Mutant> mutants : {std::span<const Mutant>(kStepRowMutants),
                                                  {kSmallIslandRowMutants},
                                                  {kPartStartMutants},
                                                  {kFindPairsMutants},
                                                  {kPairRowMutants},
                                                  {kPairGuardMutants},
                                                  {kPartEndMutants}})
        for (const Mutant& mutant : mutants) EXPECT_NO_THROW(BrokenShader{mutant}) << mutant.name;
}

}  // namespace
}  // namespace gelatin::test
