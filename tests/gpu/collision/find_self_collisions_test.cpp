#include "gpu/collision/find_self_collisions.h"

#include <gtest/gtest.h>

#include "support/folded.h"
#include "support/gl_fixture.h"
#include "support/parity.h"

namespace gelatin {
namespace {

using test::Deformation;

constexpr double kStep = 1e-3;  // [s]

class SelfCollisionOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<Deformation> {};
INSTANTIATE_TEST_SUITE_P(Deformations, SelfCollisionOnGpuTest, ::testing::ValuesIn(test::kDeformations));

TEST_P(SelfCollisionOnGpuTest, FindsWhatTheCpuFinds) {
    for (const unsigned seed : {1u, 5u}) {
        const Model model = test::make_folded(GetParam(), seed);
        EXPECT_EQ(test::find_self_contacts_on_gpu(model), test::find_self_contacts_on_cpu<float>(model));
    }
}

// Maps of a shape that was, and contacts of another, change nothing.
TEST_P(SelfCollisionOnGpuTest, FindsTheSameWhateverWasBefore) {
    const Model model = test::make_folded(GetParam());
    const test::SelfContacts expected = test::find_self_contacts_on_cpu<float>(model);
    for (const Deformation before : {Deformation::rigid, Deformation::poked, Deformation::rolled})
        EXPECT_EQ(test::find_self_contacts_on_gpu_after(test::make_folded(before), model), expected);
}

TEST_P(SelfCollisionOnGpuTest, RespondsLikeTheDoubleReference) {
    const Model model = test::make_folded(GetParam());
    for (const CollisionSettings& settings : {CollisionSettings{.friction = 0.0, .restitution = 0.0},
                                              CollisionSettings{.friction = 0.4, .restitution = 0.7}}) {
        const test::NodeArrays actual = test::respond_to_self_on_gpu(model, settings, kStep);
        // In a plane normals are as they are rounded, and tell no direction.
        const double bound = GetParam() == Deformation::flat ? 1e6 : 1.0;
        EXPECT_LE(test::worst_self_response_error(model, settings, kStep, actual), bound);
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            EXPECT_EQ(actual.positions[n].w, model.positions[n].w);
            EXPECT_EQ(actual.velocities[n].w, model.velocities[n].w);
        }
        EXPECT_TRUE(test::guard_is_untouched(actual.positions, model.node_count()));
        EXPECT_TRUE(test::guard_is_untouched(actual.velocities, model.node_count()));
    }
}

TEST_P(SelfCollisionOnGpuTest, RepeatsBitForBit) {
    const Model model = test::make_folded(GetParam(), 9);
    const test::NodeArrays one = test::respond_to_self_on_gpu(model, {}, kStep),
                           two = test::respond_to_self_on_gpu(model, {}, kStep);
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

// A map is good for as long as it explains where the nodes are: far away, too, and after a small turn.
TEST_F(SelfCollisionOnGpu, KeepsTheMapsOfBodiesThatMoveAsOne) {
    const Model start = test::make_folded(Deformation::rigid);
    Model moved = start;
    for (glm::vec4& p : moved.positions) p += glm::vec4(20.0f - 1e-3f * p.y, 1e-3f * p.x, -7.0f, 0.0f);
    std::uint32_t fitted = 1;
    test::find_self_contacts_on_gpu_after(start, moved, &fitted);
    EXPECT_EQ(fitted, 0u);
    test::find_self_contacts_on_gpu_after(start, test::make_folded(Deformation::affine), &fitted);
    EXPECT_EQ(fitted, start.objects.size());
}

}  // namespace
}  // namespace gelatin
