// Joints with values that nothing real has: what can be found is right, what cannot ends with an error.
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::extreme_joint_test {
namespace {

using namespace test;

Scene wheel(double mass, const glm::dvec3& size, double beside = 0.0) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    scene.objects = {rigid_box("wheel", size, {beside, 0.0, 0.0})};
    scene.objects[0].rigid->mass = mass;
    scene.attachments = {{.object = "wheel", .where = AttachedLine{{0.0, 0.0, -0.1}, {0.0, 0.0, 0.1}}}};
    return scene;
}

// At 7,200 rpm a part of a fourth of a frame would be half of a turn.
TEST(ExtremeJoints, MotorsTurnAtManyThousandRevolutionsAMinute) {
    for (const double rpm : {1800.0, 3600.0, 7200.0}) {
        Scene scene = wheel(0.1, glm::dvec3(0.1));
        scene.attachments[0].motor = JointMotor{.speed = 6.0 * rpm};
        MeasuredRun run(scene);
        run.advance(1.0);
        const double speed = glm::radians(6.0 * rpm), inertia = 0.1 * 0.1 * 0.1 / 6.0;
        EXPECT_NEAR(run.joint(0).speed, speed, 1e-3 * speed) << rpm;
        EXPECT_NEAR(run.statistics().kinetic_energy, 0.5 * inertia * speed * speed,
                    1e-3 * inertia * speed * speed);
        EXPECT_LT(glm::length(run.center(0)), 1e-3);
    }
}

// A spring of more than a joint holds with is as stiff as that.
TEST(ExtremeJoints, SpringsOfAnyStiffnessComeToTheirRest) {
    Scene scene = wheel(0.001, {0.8, 0.4, 0.04}, 0.4);
    scene.attachments[0].spring = JointSpring{.stiffness = 1e9, .rest = 90.0};
    MeasuredRun run(scene);
    run.advance(1.0);
    EXPECT_NEAR(run.joint(0).position, glm::radians(90.0), 1e-4);
    EXPECT_LT(run.fastest(0), 1e-3);
    EXPECT_LT(run.strain(0), 1e-5);
}

// Two motors of any force that go to different places: sooner or later no values are finite.
TEST(ExtremeJoints, WhatHasNoSolutionIsReported) {
    Scene scene = wheel(7.7, {0.8, 0.4, 0.04}, 0.4);
    scene.attachments.push_back(scene.attachments[0]);
    for (const double sign : {1.0, -1.0})
        scene.attachments[sign > 0.0 ? 0 : 1].motor = JointMotor{.position = 30.0 * sign};
    MeasuredRun run(scene);
    EXPECT_THROW(run.advance(10.0), Diverged);
}

}  // namespace
}  // namespace gelatin::extreme_joint_test
