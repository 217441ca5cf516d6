#include "model/drive/drags.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "model/assembly/build_model.h"
#include "model/transform.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 1.0 / 240.0;

Handle make_handle(double most_speed) {
    Handle handle;
    handle.radius = 0.5;
    handle.most_speed = most_speed;
    return handle;
}

glm::dquat about_z(double angle) {
    return glm::angleAxis(angle, glm::dvec3(0.0, 0.0, 1.0));
}

// What is left to go shrinks as exp(-rate t), to the first order of the step.
TEST(Drags, FollowExponentially) {
    const Handle handle = make_handle(1e3);
    const Drag target{{0.3, 0.0, -0.4}, about_z(0.8)};
    Drag drag;
    for (int s = 0; s < 24; ++s) drag = follow(drag, target, handle, kStep);
    const double left = std::pow(1.0 - kDragRate * kStep, 24);
    EXPECT_NEAR(glm::distance(drag.move, target.move), 0.5 * left, 1e-12);
    EXPECT_NEAR(glm::angle(target.turn * glm::conjugate(drag.turn)), 0.8 * left, 1e-12);
    EXPECT_NEAR(left, std::exp(-kDragRate * 0.1), 0.02);
}

TEST(Drags, AreNoFasterThanTheBodyFollows) {
    const Handle handle = make_handle(2.0);
    const Drag target{{10.0, 0.0, 0.0}, about_z(3.0)};
    const Drag drag = follow({}, target, handle, kStep);
    EXPECT_NEAR(drag.move.x + 0.5 * glm::angle(drag.turn), 2.0 * kStep, 1e-12);
    EXPECT_NEAR(drag.move.x / 10.0, glm::angle(drag.turn) / 3.0, 1e-12) << "both arrive together";
}

// To the last bit, and in time: from one millimetre in as many steps as 1 mm takes at a thousandth of 2 m/s.
TEST(Drags, Arrive) {
    const Handle handle = make_handle(4.0);
    const Drag target{{0.001, 0.0, 0.0}, about_z(-0.001)};
    Drag drag;
    int steps = 0;
    for (; drag != target && steps < 1000; ++steps) drag = follow(drag, target, handle, kStep);
    EXPECT_LE(steps, 120);
    EXPECT_EQ(follow(target, target, handle, kStep), target);
}

TEST(Drags, AreOnTopOfKeyframes) {
    Handle handle;
    handle.pivot = {1.0, 2.0, 3.0};
    handle.keyframes = {{0.0}, {2.0, {1.0, 0.0, 0.0}, {0.0, 0.0, 180.0}, 3.0}};
    const Drag drag{{0.0, 0.5, 0.0}, about_z(std::numbers::pi / 2.0)};
    const HandlePose pose = pose_at(handle, 1.0, drag);
    EXPECT_LT(glm::distance(pose.center, glm::dvec3(1.5, 2.5, 3.0)), 1e-12);
    // A quarter turn by the keyframes, one by the drag, and twice the size.
    EXPECT_LT(glm::distance(pose.place({1.0, 0.0, 0.0}), pose.center + glm::dvec3(-2.0, 0.0, 0.0)), 1e-12);
}

TEST(Drags, MotionsLeadFromOneToTheNext) {
    Body body = test::make_body(test::make_block({2, 2, 2}, {0.4, 0.2, 0.2}));
    body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}};
    const auto model = std::make_shared<const Model>(test::make_model(body));
    ASSERT_EQ(model->handles.size(), 1u);
    Drags drags(model);
    EXPECT_FALSE(drags.may_move());
    drags.set_target(0, {{0.1, 0.0, 0.0}, about_z(0.3)});
    EXPECT_TRUE(drags.may_move());
    EXPECT_TRUE(drags.is_under_way());
    for (int s = 0; s < 3; ++s) drags.advance({{s * kStep}, {s * kStep + kStep}}, kStep);
    const HandlePose start = pose_at(model->handles[0], 0.0, drags.drags()[0]);
    const HandleMotion motion = drags.advance({{3 * kStep}, {4 * kStep}}, kStep).at(0);
    const HandlePose end = pose_at(model->handles[0], 0.0, drags.drags()[0]);
    EXPECT_LT(glm::distance(glm::dvec3(motion.center), start.center), 1e-7);
    EXPECT_LT(glm::distance(kStep * glm::dvec3(motion.velocity), end.center - start.center), 1e-8);
    EXPECT_LT(glm::distance(kStep * glm::dvec3(motion.rate_x), end.map[0] - start.map[0]), 1e-8);
    EXPECT_EQ(motion.center.w, 1.0f);

    drags.restart();
    EXPECT_EQ(drags.drags()[0], Drag());
    EXPECT_FALSE(drags.may_move());
}

// What a scene says of its handles is followed from the start on.
TEST(Drags, BeginWithTheScenes) {
    Body body = test::make_body(test::make_block({2, 2, 2}, {0.4, 0.2, 0.2}));
    HandleDescription description;
    description.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    description.drag = {{0.0, 0.2, 0.0}, {0.0, 30.0, 0.0}};
    body.handles = {description};
    Drags drags(std::make_shared<const Model>(test::make_model(body)));
    EXPECT_TRUE(drags.is_under_way());
    EXPECT_EQ(drags.drags()[0], Drag());
    for (int s = 0; s < 2000 && drags.is_under_way(); ++s)
        drags.advance({{s * kStep}, {s * kStep + kStep}}, kStep);
    EXPECT_EQ(drags.drags()[0].move, glm::dvec3(0.0, 0.2, 0.0));
    EXPECT_EQ(drags.drags()[0].turn, rotation_from_degrees({0.0, 30.0, 0.0}));
    EXPECT_TRUE(drags.may_move()) << "a step more takes the velocity away";
}

// A rigid motion is found again whatever it is; of nodes on a line the least turn that will do.
TEST(Drags, NearestIsTheRigidMotionItself) {
    const HandlePose pose{{1.0, -2.0, 0.5}, glm::mat3_cast(rotation_from_degrees({10.0, 20.0, 30.0}))};
    const std::vector<glm::dvec3> arms = {
        {0.1, 0.0, 0.0}, {0.0, 0.2, 0.1}, {-0.3, 0.1, 0.0}, {0.0, 0.0, 0.4}};
    const auto error = [&](const Drag& drag, std::size_t count) {
        const HandlePose moved{pose.center + drag.move, glm::mat3_cast(drag.turn) * pose.map};
        std::vector<glm::dvec3> places;
        for (std::size_t i = 0; i < count; ++i) places.push_back(moved.place(arms[i]));
        const Drag found = nearest_drag(pose, std::span(arms).first(count), places);
        const HandlePose again{pose.center + found.move, glm::mat3_cast(found.turn) * pose.map};
        double worst = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            worst = std::max(worst, glm::distance(again.place(arms[i]), places[i]));
        return worst;
    };
    for (const double angle : {0.0, 1e-9, 0.5, std::numbers::pi, 4.0}) {
        const Drag drag{{0.5, -0.1, 7.0}, glm::angleAxis(angle, glm::normalize(glm::dvec3(1.0, -2.0, 0.3)))};
        EXPECT_LT(error(drag, 4), 1e-12) << angle;
        EXPECT_LT(error(drag, 3), 1e-12) << angle;
        EXPECT_LT(error(drag, 2), 1e-8) << angle;
    }
    const Drag moved{{0.5, -0.1, 7.0}, {1.0, 0.0, 0.0, 0.0}};
    const std::vector<glm::dvec3> place = {pose.place(arms[0]) + moved.move};
    const Drag found = nearest_drag(pose, std::span(arms).first(1), place);
    EXPECT_LT(glm::distance(found.move, moved.move), 1e-12);
    EXPECT_LT(glm::angle(found.turn), 1e-9) << "a node alone does not turn";
}

// A node that is in two of them belongs to the first; the ends of the body move no faster than it can follow.
TEST(Drags, PinsAreHandlesWithoutKeyframes) {
    Body body = test::make_body(test::make_block({4, 2, 2}, {0.4, 0.2, 0.2}));
    body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.11}, HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01},
                 HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.21}};
    const Model model = test::make_model(body);
    ASSERT_EQ(model.handles.size(), 3u);
    EXPECT_EQ(model.handles[0].count, 18u);
    EXPECT_EQ(model.handles[1].count, 0u);
    EXPECT_EQ(model.handles[2].count, 9u);
    for (std::size_t h = 0; h < 3; ++h) {
        EXPECT_TRUE(model.handles[h].is_pin);
        EXPECT_EQ(model.handles[h].index, h);
    }
    EXPECT_LT(glm::distance(model.handles[2].pivot, glm::dvec3(0.2, 0.1, 0.1)), 1e-12);
    EXPECT_NEAR(model.handles[2].radius, std::sqrt(0.02), 1e-12);
    const double waves = std::sqrt(body.material.youngs_modulus / body.material.density);
    EXPECT_NEAR(model.handles[0].most_speed, std::min(waves / 3.0, kDragRate * std::sqrt(0.24)), 1e-9);
}

TEST(Transform, DegreesAreFoundAgain) {
    for (const glm::dvec3& degrees :
         {glm::dvec3(0.0), glm::dvec3(10.0, 20.0, 30.0), glm::dvec3(-170.0, 80.0, 100.0),
          glm::dvec3(0.0, 90.0, 0.0), glm::dvec3(40.0, -90.0, 25.0), glm::dvec3(180.0, 0.0, 0.0),
          glm::dvec3(300.0, 200.0, -400.0)}) {
        const glm::dquat rotation = rotation_from_degrees(degrees);
        const glm::dquat again = rotation_from_degrees(degrees_from_rotation(rotation));
        EXPECT_NEAR(std::abs(glm::dot(rotation, again)), 1.0, 1e-12) << degrees.x;
    }
}

}  // namespace
}  // namespace gelatin
