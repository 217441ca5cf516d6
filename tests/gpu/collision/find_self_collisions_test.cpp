#include "gpu/collision/find_self_collisions.h"

#include <gtest/gtest.h>

#include "gpu/support/collision_scenarios.h"
#include "support/folded.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

using test::Deformation;

constexpr double kSelfStep = 1e-3;  // [s]

class SelfCollisionParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, SelfCollisionParityTest, ::testing::ValuesIn(test::self_collision_scenarios()),
                         test::name_of_scenario);

TEST_P(SelfCollisionParityTest, FindsWhatTheCpuFinds) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class CalmParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, CalmParityTest, ::testing::ValuesIn(test::calm_scenarios()),
                         test::name_of_scenario);

TEST_P(CalmParityTest, LooksAtNoMoreThanTheCpu) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class SelfResponseParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, SelfResponseParityTest, ::testing::ValuesIn(test::self_response_scenarios()),
                         test::name_of_scenario);

TEST_P(SelfResponseParityTest, MatchesTheDoubleReference) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class SelfCollisionOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<Deformation> {};
INSTANTIATE_TEST_SUITE_P(Deformations, SelfCollisionOnGpuTest, ::testing::ValuesIn(test::kDeformations));

TEST_P(SelfCollisionOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_folded(GetParam(), 9);
    const test::NodeArrays one = test::respond_to_self_on_gpu(model, {}, kSelfStep),
                           two = test::respond_to_self_on_gpu(model, {}, kSelfStep);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        EXPECT_EQ(one.positions[n], two.positions[n]);
        EXPECT_EQ(one.velocities[n], two.velocities[n]);
    }
}

using SelfCollisionOnGpu = test::GlTest;

TEST_F(SelfCollisionOnGpu, LetsUndeformedBodiesBe) {
    for (const Deformation deformation : {Deformation::rigid, Deformation::affine}) {
        std::uint32_t restless = 1;
        test::find_self_contacts_on_gpu(test::make_folded(deformation), &restless);
        EXPECT_EQ(restless, 0u);
    }
}

// Other than by a small turn (CalmParityTest).
TEST_F(SelfCollisionOnGpu, FitsNewMapsToDeformedBodies) {
    const Model start = test::make_folded(Deformation::rigid);
    std::uint32_t fitted = 0;
    test::find_self_contacts_on_gpu_after(start, test::make_folded(Deformation::affine), &fitted);
    EXPECT_EQ(fitted, start.objects.size());
}

}  // namespace
}  // namespace gelatin
