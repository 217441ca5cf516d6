#include "model/drive/handles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "model/model.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kPi = std::numbers::pi;

Handle make_handle(Interpolation interpolation = Interpolation::linear) {
    Handle handle;
    handle.pivot = {1.0, 2.0, 3.0};
    handle.interpolation = interpolation;
    handle.keyframes = {{1.0}, {3.0, {0.4, 0.0, -0.2}, {0.0, 0.0, 720.0}, 2.0}, {4.0, {0.4, 1.0, -0.2}}};
    return handle;
}

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0.0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, glm::distance(a[c], b[c]));
    return largest;
}

// About z, with a scale.
glm::dmat3 turn(double angle, double scale) {
    return {glm::dvec3(scale * std::cos(angle), scale * std::sin(angle), 0.0),
            glm::dvec3(-scale * std::sin(angle), scale * std::cos(angle), 0.0), glm::dvec3(0.0, 0.0, scale)};
}

TEST(Handles, InterpolateByComponent) {
    for (const double s : {0.0, 0.125, 0.3, 0.5, 0.99, 1.0}) {
        const HandlePose pose = pose_at(make_handle(), 1.0 + 2.0 * s);
        EXPECT_LT(glm::distance(pose.center, glm::dvec3(1.0 + 0.4 * s, 2.0, 3.0 - 0.2 * s)), 1e-12);
        EXPECT_LT(largest_difference(pose.map, turn(4.0 * kPi * s, 1.0 + s)), 1e-12) << s;
    }
    const HandlePose later = pose_at(make_handle(), 3.25);
    EXPECT_LT(glm::distance(later.center, glm::dvec3(1.4, 2.25, 2.8)), 1e-12);
    EXPECT_LT(largest_difference(later.map, turn(-kPi, 1.75)), 1e-12) << "back from two turns";
}

TEST(Handles, SmoothStartsAndEndsAtRest) {
    const Handle handle = make_handle(Interpolation::smooth);
    for (const double s : {0.1, 0.5, 0.8}) {
        const double eased = s * s * (3.0 - 2.0 * s);
        const HandlePose pose = pose_at(handle, 1.0 + 2.0 * s);
        EXPECT_NEAR(pose.center.x, 1.0 + 0.4 * eased, 1e-12);
        EXPECT_LT(largest_difference(pose.map, turn(4.0 * kPi * eased, 1.0 + eased)), 1e-12);
    }
    constexpr double kMoment = 1e-6;  // [s]
    for (const double time : {1.0, 3.0, 4.0}) {
        const glm::dvec3 displacement =
            pose_at(handle, time + kMoment).center - pose_at(handle, time - kMoment).center;
        EXPECT_LT(glm::length(displacement) / kMoment, 1e-5) << time;
    }
}

TEST(Handles, RestBeforeTheFirstKeyframeAndAfterTheLast) {
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
        const Handle handle = make_handle(interpolation);
        for (const double time : {0.0, 0.7, 1.0}) {
            EXPECT_EQ(pose_at(handle, time).center, handle.pivot);
            EXPECT_EQ(pose_at(handle, time).map, glm::dmat3(1.0));
        }
        for (const double time : {4.0, 1e6}) {
            EXPECT_EQ(pose_at(handle, time).center, pose_at(handle, 4.0).center);
            EXPECT_EQ(pose_at(handle, time).map, glm::dmat3(1.0));
        }
    }
    EXPECT_EQ(pose_at(Handle{}, 3.0).map, glm::dmat3(1.0)) << "without keyframes it is a pin";
}

// A step's motion leads from the pose at its start to that at its end.
TEST(Handles, MotionsLeadThroughTheStep) {
    const Handle handle = make_handle();
    const double time = 1.7, step = 1.0 / 240.0;
    const HandleMotion motion = handle_motions({handle}, time, step).at(0);
    const HandlePose end = pose_at(handle, time + step);
    const auto after = [&](const glm::vec4& at, const glm::vec4& rate) {
        return glm::dvec3(at) + step * glm::dvec3(rate);
    };
    EXPECT_LT(glm::distance(after(motion.center, motion.velocity), end.center), 1e-6);
    EXPECT_LT(glm::distance(after(motion.map_x, motion.rate_x), end.map[0]), 1e-6);
    EXPECT_LT(glm::distance(after(motion.map_y, motion.rate_y), end.map[1]), 1e-6);
    EXPECT_LT(glm::distance(after(motion.map_z, motion.rate_z), end.map[2]), 1e-6);
    EXPECT_NEAR(motion.velocity.x, 0.2, 1e-6);
    EXPECT_NEAR(glm::length(glm::vec3(motion.rate_x)), 4.0 * kPi / 2.0 * 1.35, 0.5) << "w r";
}

// The first free step is the one that begins nearest to the release, whatever rounding says.
TEST(Handles, ReleaseAtTheNearestStep) {
    Handle handle = make_handle();
    handle.release = 2.0;
    const double step = 1.0 / 60.0;
    const auto is_held = [&](double time) {
        return handle_motions({handle}, time, step)[0].center.w == 1.0f;
    };
    EXPECT_TRUE(is_held(119 * step));
    EXPECT_FALSE(is_held(120 * step));
    EXPECT_FALSE(is_held(std::nextafter(2.0, 0.0)));
    EXPECT_FALSE(is_held(5.0));
    EXPECT_TRUE(handle_motions({make_handle()}, 1e9, step)[0].center.w == 1.0f) << "never";
}

TEST(Handles, TakeTheMassOfTheirNodesAndTurnAboutTheirCentre) {
    Body body = test::make_body(test::make_block({4, 2, 2}, {0.4, 0.2, 0.2}));
    body.velocity = {1.0, 2.0, 3.0};
    HandleDescription description;
    description.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    body.handles = {description};
    const Model model = test::make_model(body);
    ASSERT_EQ(model.handle_nodes.size(), 9u);
    EXPECT_EQ(model.objects[0].handle_nodes.count, 9u);
    EXPECT_LT(glm::distance(model.handles[0].pivot, glm::dvec3(0.0, 0.1, 0.1)), 1e-12);
    for (const HandleNode& held : model.handle_nodes) {
        const glm::vec4& position = model.positions[held.node];
        EXPECT_EQ(position.w, 0.0f);
        EXPECT_EQ(glm::vec3(model.velocities[held.node]), glm::vec3(0.0f));
        EXPECT_EQ(held.arm.w, 1.0f / model.masses[held.node]);
        EXPECT_LT(glm::distance(glm::dvec3(held.arm) + model.handles[0].pivot, glm::dvec3(position)), 1e-7);
    }
}

// Before, between and behind its keyframes, and about its release.
TEST(Handles, ActWhileTheyMoveAndWhenTheyLetGo) {
    Handle handle;
    handle.release = 3.0;
    handle.keyframes = {{1.0}, {2.0, {1.0, 0.0, 0.0}}};
    const auto acts = [&](double from, double until) { return any_acts({handle}, from, until, 0.01); };
    EXPECT_TRUE(acts(0.0, 0.1)) << "it takes its nodes to the first keyframe";
    EXPECT_FALSE(acts(0.1, 1.0));
    EXPECT_TRUE(acts(0.1, 1.1));
    EXPECT_TRUE(acts(1.9, 2.5));
    EXPECT_FALSE(acts(2.0, 2.5));
    EXPECT_TRUE(acts(2.5, 3.0));
    EXPECT_TRUE(acts(3.0, 3.5));
    EXPECT_FALSE(acts(3.02, 9.0));
    handle.keyframes.clear();
    EXPECT_FALSE(acts(0.0, 2.0));
    EXPECT_FALSE(any_acts({}, 0.0, 1e9, 0.01));
}

}  // namespace
}  // namespace gelatin
