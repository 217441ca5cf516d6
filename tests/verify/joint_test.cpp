// Joints of rigid bodies against closed forms: springs, dampers, motors and limits of hinges and sliders,
// universal joints, rods and ropes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "gelatin/recording.h"
#include "gelatin/simulator.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::joint_test {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;

// A bar of 1 kg along x, on a hinge about z at the origin.
Scene bar_on_hinge(const glm::dvec3& gravity = glm::dvec3(0.0)) {
    Scene scene = rigid_scene(0.5, gravity);
    scene.objects = {rigid_box("bar", {1.0, 0.1, 0.1}, {0.5, 0.0, 0.0})};
    scene.objects[0].rigid->mass = 1.0;
    scene.attachments = {{.object = "bar", .where = AttachedLine{{0.0, 0.0, -0.05}, {0.0, 0.0, 0.05}}}};
    return scene;
}
constexpr double kBarInertia = (1.0 + 0.01) / 12.0 + 0.25;  // about the hinge

// A box of 1 kg on a rail through the origin.
Scene box_on_rail(const glm::dvec3& along, const glm::dvec3& gravity = glm::dvec3(0.0)) {
    Scene scene = rigid_scene(0.5, gravity);
    scene.objects = {rigid_box("box", {0.1, 0.1, 0.1}, {0.0, 0.0, 0.0})};
    scene.attachments = {{.object = "box", .where = AttachedRail{{0.0, 0.0, 0.0}, along}}};
    return scene;
}

// Times at which a coordinate passes through `middle` upwards.
std::vector<double> crossings(MeasuredRun& run, double middle, std::size_t count) {
    std::vector<double> times;
    for (double before = middle + 1.0; times.size() < count && run.simulator().time() < 60.0;) {
        run.advance(1.0 / 60.0);
        const double now = run.joint(0).position - middle;
        if (before < 0.0 && now >= 0.0) times.push_back(run.simulator().time() - now / (now - before) / 60.0);
        before = now;
    }
    return times;
}

TEST(Joints, SwingOnTheirSprings) {
    const double period = 1.5, way = 2.0 * kPi / period;
    Scene hinge = bar_on_hinge();
    hinge.objects[0].spin = {0.0, 0.0, 40.0};
    hinge.objects[0].velocity = {0.0, glm::radians(40.0) * 0.5, 0.0};
    hinge.attachments[0].spring = JointSpring{.stiffness = kBarInertia * way * way};
    Scene slider = box_on_rail({1.0, 2.0, -1.0}, {0.0, -kGravity, 0.0});
    slider.attachments[0].spring = JointSpring{.stiffness = way * way};
    Scene rod = bar_on_hinge();
    rod.objects[0].velocity = {0.4, 0.0, 0.0};
    rod.attachments = {{.object = "bar",
                        .where = AttachedDistance{{0.5, 0.0, 0.0}, {-0.5, 0.0, 0.0}},
                        .spring = JointSpring{.stiffness = way * way}}};
    const double sag = -kGravity * 2.0 / std::sqrt(6.0) / (way * way);
    for (const auto& [scene, middle] : {std::pair(hinge, 0.0), std::pair(slider, sag), std::pair(rod, 1.0)}) {
        MeasuredRun run(scene);
        const double energy = run.statistics().kinetic_energy;
        const std::vector<double> times = crossings(run, middle, 5);
        ASSERT_EQ(times.size(), 5u);
        EXPECT_NEAR((times[4] - times[0]) / 4.0, period, 0.01 * period);
        if (middle == 0.0) {
            EXPECT_GT(run.statistics().kinetic_energy, 0.0);
            EXPECT_LT(run.statistics().kinetic_energy, 1.001 * energy);
        }
    }
}

TEST(Joints, DampersTakeSpeed) {
    const double time = 0.5;  // in which it falls to 1 / e
    Scene hinge = bar_on_hinge();
    hinge.objects[0].spin = {0.0, 0.0, 200.0};
    hinge.objects[0].velocity = {0.0, glm::radians(200.0) * 0.5, 0.0};
    hinge.attachments[0].spring = JointSpring{.damping = kBarInertia / time};
    Scene slider = box_on_rail({1.0, 0.0, 0.0});
    slider.objects[0].velocity = {3.0, 0.0, 0.0};
    slider.attachments[0].spring = JointSpring{.damping = 1.0 / time};
    for (const Scene& scene : {hinge, slider}) {
        MeasuredRun run(scene);
        const double first = run.joint(0).speed;
        EXPECT_GT(first, 2.9);
        run.advance(1.0);
        EXPECT_NEAR(run.joint(0).speed, first * std::exp(-2.0), 0.03 * first * std::exp(-2.0));
    }
}

TEST(Joints, SlideWithoutFriction) {
    MeasuredRun run(box_on_rail({1.0, -1.0, 0.0}, {0.0, -kGravity, 0.0}));
    run.advance(1.0);
    const double way = 0.5 * kGravity / std::sqrt(2.0);
    EXPECT_NEAR(run.joint(0).position, way, 0.01 * way);
    EXPECT_NEAR(run.joint(0).speed, 2.0 * way, 0.01 * way);
    EXPECT_LT(glm::distance(run.center(0), way / std::sqrt(2.0) * glm::dvec3(1.0, -1.0, 0.0)), 0.01 * way);
    EXPECT_LT(glm::distance(run.force(0), kGravity / 2.0 * glm::dvec3(1.0, 1.0, 0.0)), 0.01 * kGravity);
}

// On a rail that turns, a box goes outwards as r = r_0 cosh(w t).
TEST(Joints, SlideOnWhatTurns) {
    Scene scene = bar_on_hinge();
    scene.objects.push_back(rigid_box("box", {0.1, 0.1, 0.1}, {0.2, 0.0, 0.0}));
    scene.objects[1].rigid->mass = 1e-3;  // hardly slows the bar
    const double w = 3.0;
    scene.attachments[0].motor = JointMotor{.speed = glm::degrees(w)};
    scene.objects[0].spin = scene.objects[1].spin = {0.0, 0.0, glm::degrees(w)};
    scene.objects[0].velocity = {0.0, 0.5 * w, 0.0};
    scene.objects[1].velocity = {0.0, 0.2 * w, 0.0};
    scene.attachments.push_back(
        {.object = "box", .to = "bar", .where = AttachedRail{{0.2, 0.0, 0.0}, {1.0, 0.0, 0.0}}});
    MeasuredRun run(scene);
    run.advance(1.0);
    const double way = 0.2 * (std::cosh(w) - 1.0);
    EXPECT_NEAR(run.joint(0).speed, w, 1e-3 * w);
    EXPECT_NEAR(run.joint(1).position, way, 0.01 * way);
    EXPECT_NEAR(glm::length(run.center(1)), 0.2 + way, 0.01 * way);
}

TEST(Joints, MotorsReachTheirSpeedByTheirForce) {
    Scene hinge = bar_on_hinge();
    hinge.attachments[0].motor = JointMotor{.speed = 180.0, .force = 1.0};
    Scene slider = box_on_rail({0.0, 0.0, 2.0});
    slider.attachments[0].motor = JointMotor{.speed = kPi, .force = 1.0 / kBarInertia};
    for (const Scene& scene : {hinge, slider}) {
        MeasuredRun run(scene);
        const double force = *scene.attachments[0].motor->force;
        run.advance(0.5);
        EXPECT_NEAR(run.joint(0).speed, 0.5 / kBarInertia, 0.01 * 0.5 / kBarInertia);
        EXPECT_NEAR(run.joint(0).effort, force, 0.005 * force);
        run.advance(1.5);
        EXPECT_NEAR(run.joint(0).speed, kPi, 1e-3 * kPi);
        EXPECT_LT(std::abs(run.joint(0).effort), 0.01 * force);
    }
}

// It holds a bar level, goes where keyframes say, and where a program says.
TEST(Joints, MotorsGoToPositions) {
    Scene scene = bar_on_hinge({0.0, -kGravity, 0.0});
    scene.attachments[0].motor =
        JointMotor{.position = 0.0, .keyframes = {{.time = 1.0, .speed = 45.0, .position = 60.0}}};
    MeasuredRun run(scene);
    const auto torque = [&] { return 0.5 * kGravity * std::cos(run.joint(0).position); };
    run.advance(1.0);
    EXPECT_NEAR(run.joint(0).position, 0.0, glm::radians(0.1));
    EXPECT_NEAR(run.joint(0).effort, torque(), 0.005 * torque());
    run.advance(1.0);
    EXPECT_NEAR(run.joint(0).position, glm::radians(45.0), glm::radians(1.0));
    EXPECT_NEAR(run.joint(0).speed, glm::radians(45.0), glm::radians(0.5));
    run.advance(1.0);
    EXPECT_NEAR(run.joint(0).position, glm::radians(60.0), glm::radians(0.1));
    EXPECT_LT(run.fastest(0), 1e-3);
    run.simulator().set_motor(0, {.speed = 90.0, .position = -30.0});
    run.advance(1.5);
    EXPECT_NEAR(run.joint(0).position, glm::radians(-30.0), glm::radians(0.1));
    run.simulator().reset();
    run.advance(1.0);
    EXPECT_NEAR(run.joint(0).position, 0.0, glm::radians(0.1));
}

// What a program has set of a motor is in checkpoints and recordings, and goes over to a scene like this one.
TEST(Joints, MotorsGoOnFromACheckpoint) {
    const auto folder = std::filesystem::path(::testing::TempDir());
    const Scene scene = bar_on_hinge({0.0, -kGravity, 0.0});
    MeasuredRun run(scene), other(scene), recorded(scene), next(scene);
    const JointMotor motor{.speed = 90.0, .position = -30.0, .keyframes = {{.time = 0.6, .position = 20.0}}};
    run.simulator().set_motor(0, motor);
    run.advance(0.5);
    run.simulator().save_checkpoint(folder / "motor.gelatin");
    RecordingWriter writer(folder / "motor.gel", run.simulator());
    writer.write(run.simulator());
    writer.finish();
    other.simulator().load_checkpoint(folder / "motor.gelatin");
    recorded.simulator().load_checkpoint(folder / "motor.gel");
    next.simulator().go_on_from(run.simulator());
    for (MeasuredRun* each : {&run, &other, &recorded, &next}) each->advance(0.5);
    EXPECT_GT(run.joint(0).position, glm::radians(1.0)) << "by the keyframe";
    EXPECT_EQ(other.joint(0).position, run.joint(0).position);
    EXPECT_NEAR(recorded.joint(0).position, run.joint(0).position, glm::radians(0.5));
    EXPECT_NEAR(next.joint(0).position, run.joint(0).position, glm::radians(0.5));
    // A checkpoint without any: what was set is no more.
    MeasuredRun idle(scene);
    idle.simulator().save_checkpoint(folder / "idle.gelatin");
    other.simulator().load_checkpoint(folder / "idle.gelatin");
    other.advance(0.5);
    EXPECT_LT(other.joint(0).position, -glm::radians(40.0)) << "it falls";
}

// 320 J, of which the watch on energy knows nothing.
TEST(Joints, SpringsGiveWhatTheyHold) {
    Scene scene = box_on_rail({1.0, 0.0, 0.0});
    scene.objects[0].rigid->mass = 1.0;
    scene.attachments[0].spring = JointSpring{.stiffness = 1000.0, .rest = 0.8};
    MeasuredRun run(scene);
    double fastest = 0.0;
    for (int frame = 0; frame < 30; ++frame) {
        run.advance(1.0 / 60.0);
        run.statistics();
        fastest = std::max(fastest, std::abs(run.joint(0).speed));
    }
    EXPECT_NEAR(fastest, 0.8 * std::sqrt(1000.0), 2.0);
}

TEST(Joints, MotorsOfAnyForceStopAtTheirLimits) {
    Scene hinge = bar_on_hinge(), rail = box_on_rail({1.0, 0.0, 0.0});
    hinge.attachments[0].limits = {0.0, 90.0};
    hinge.attachments[0].motor = JointMotor{.speed = 120.0};
    rail.attachments[0].limits = {-0.2, 1.0};
    rail.attachments[0].motor = JointMotor{.speed = 0.5, .position = -1.0};
    MeasuredRun door(hinge), slider(rail);
    for (int frame = 0; frame < 90; ++frame) {
        for (MeasuredRun* run : {&door, &slider}) run->advance(1.0 / 60.0);
        ASSERT_LT(door.joint(0).position, glm::radians(90.1)) << frame;
        ASSERT_GT(slider.joint(0).position, -0.2002) << frame;
    }
    EXPECT_NEAR(door.joint(0).position, glm::radians(90.0), 1e-3);
    EXPECT_NEAR(slider.joint(0).position, -0.2, 1e-4);
    EXPECT_LT(std::abs(door.joint(0).speed), 1e-3);
}

// What they learnt of how fast they can brake was not that they cannot move at all.
TEST(Joints, MotorsGoOnAfterTheyWereTooWeak) {
    Scene stalled = box_on_rail({1.0, 0.0, 0.0});
    ColliderDescription wall;
    wall.shape = BoxShape{{0.2, 1.0, 1.0}};
    wall.position = {0.35, 0.0, 0.0};
    stalled.colliders = {wall};
    stalled.attachments[0].motor = JointMotor{.speed = 0.5,
                                              .position = 1.0,
                                              .force = 100.0,
                                              .keyframes = {{.time = 1.5, .position = -1.0, .force = 1e4}}};
    MeasuredRun run(stalled);
    run.advance(1.5);
    EXPECT_NEAR(run.joint(0).position, 0.2, 0.01) << "at the wall";
    run.advance(1.5);
    EXPECT_NEAR(run.joint(0).position, 0.2 - 0.75, 0.02);
    Scene weak = box_on_rail({0.0, 1.0, 0.0}, {0.0, -kGravity, 0.0});
    ColliderDescription floor;
    floor.shape = PlaneCollider{.offset = -0.051};
    weak.colliders = {floor};
    weak.attachments[0].motor =
        JointMotor{.speed = 0.5, .position = 1.0, .force = 0.0, .keyframes = {{.time = 0.5, .force = 50.0}}};
    MeasuredRun lifted(weak);
    lifted.advance(1.5);
    EXPECT_GT(lifted.joint(0).position, 0.4);
}

// With so little force that it has to brake early.
TEST(Joints, MotorsDoNotOvershoot) {
    for (const double force : {0.1, 1.0, 10.0}) {
        Scene scene = box_on_rail({1.0, 0.0, 0.0});
        scene.attachments[0].motor = JointMotor{.speed = 0.8, .position = 0.5, .force = force};
        MeasuredRun run(scene);
        double most = 0.0;
        for (int frame = 0; frame < 480; ++frame) {
            run.advance(1.0 / 60.0);
            most = std::max(most, run.joint(0).position);
        }
        EXPECT_LT(most, 0.505) << force;
        EXPECT_NEAR(run.joint(0).position, 0.5, 1e-3) << force;
        EXPECT_LT(run.fastest(0), 1e-3) << force;
    }
}

// A heavy body hangs on a light one, whose motor holds both.
TEST(Joints, MotorsHoldAThousandTimesTheirMass) {
    Scene scene = box_on_rail({0.0, 1.0, 0.0}, {0.0, -kGravity, 0.0});
    scene.objects.push_back(rigid_box("load", {0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}));
    scene.objects[1].rigid->mass = 1000.0;
    scene.attachments[0].motor = JointMotor{.speed = 0.5, .position = 0.2};
    scene.attachments.push_back(
        {.object = "load", .to = "box", .where = AttachedDistance{{0.0, -0.75, 0.0}, {0.0, 0.0, 0.0}}});
    MeasuredRun run(scene);
    for (int frame = 0; frame < 240; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_NEAR(run.joint(1).position, 0.75, 0.0075) << frame;
        ASSERT_GT(run.joint(0).position, -0.02) << frame;
    }
    EXPECT_NEAR(run.joint(0).position, 0.2, 1e-3);
    EXPECT_NEAR(run.joint(0).effort, 1001.0 * kGravity, 1e-3 * 1001.0 * kGravity);
}

// Against a block, with all that it has: at rest, and what it exerts is its torque.
TEST(Joints, MotorsAtTheirLimitDoNotTremble) {
    Scene scene = bar_on_hinge();
    add_floor(scene);
    scene.colliders[0].shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.4};
    scene.attachments[0].motor = JointMotor{.speed = -90.0, .force = 20.0};
    MeasuredRun run(scene);
    run.advance(2.0);
    for (int frame = 0; frame < 60; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_LT(run.fastest(0), 2e-3) << frame;
        ASSERT_NEAR(run.joint(0).effort, -20.0, 0.01) << frame;
        ASSERT_LT(run.strain(0), 1e-5);
    }
}

TEST(Joints, StopAtTheirLimits) {
    Scene hinge = bar_on_hinge({0.0, -kGravity, 0.0});
    hinge.attachments[0].limits = {-30.0, 10.0};
    Scene slider = box_on_rail({0.0, 1.0, 0.0}, {0.0, -kGravity, 0.0});
    slider.attachments[0].limits = {-0.3, 0.1};
    Scene rope = box_on_rail({0.0, 1.0, 0.0}, {0.0, -kGravity, 0.0});
    rope.attachments = {{.object = "box",
                         .where = AttachedDistance{{0.0, 0.05, 0.0}, {0.0, 0.15, 0.0}},
                         .limits = {{0.0, 0.4}}}};
    struct Case {
        Scene scene;
        double least, most, effort, error;
    };
    for (const auto& [scene, least, most, effort, error] :
         {Case{hinge, -kPi / 6.0, kPi / 18.0, 0.5 * kGravity * std::cos(kPi / 6.0), glm::radians(0.1)},
          Case{slider, -0.3, 0.1, kGravity, 1e-3}, Case{rope, 0.1, 0.4, -kGravity, 1e-3}}) {
        MeasuredRun run(scene);
        const double energy = run.energy();
        for (int frame = 0; frame < 120; ++frame) {
            run.advance(1.0 / 60.0);
            ASSERT_GT(run.joint(0).position, least - error) << frame;
            ASSERT_LT(run.joint(0).position, most + error) << frame;
            ASSERT_LT(run.energy(), energy + 1e-3) << frame;
        }
        EXPECT_LT(run.fastest(0), 1e-3);
        EXPECT_NEAR(run.joint(0).effort, effort, 0.01 * std::abs(effort));
    }
}

// Of two shafts at an angle b, as tan(theta_1) = cos(b) tan(theta_2).
TEST(Joints, UniversalJointsTurnShafts) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    const double b = glm::radians(35.0);
    const glm::dvec3 along(std::cos(b), 0.0, -std::sin(b));  // of the second
    scene.objects = {rigid_box("first", {0.4, 0.06, 0.06}, {-0.25, 0.0, 0.0}),
                     rigid_box("second", {0.4, 0.06, 0.06}, 0.25 * along)};
    scene.objects[1].rotation = {0.0, 35.0, 0.0};
    scene.attachments = {
        {.object = "first", .where = AttachedLine{{-0.4, 0.0, 0.0}, {-0.1, 0.0, 0.0}}},
        {.object = "second", .where = AttachedLine{0.1 * along, 0.4 * along}},
        {.object = "second",
         .to = "first",
         .where = AttachedUniversal{glm::dvec3(0.0), {std::sin(b), 0.0, std::cos(b)}, {0.0, 1.0, 0.0}}}};
    scene.attachments[0].motor = JointMotor{.speed = 90.0};
    MeasuredRun run(scene);
    for (int frame = 0; frame < 480; ++frame) {
        run.advance(1.0 / 60.0);
        const double first = run.joint(0).position, second = run.joint(1).position;
        // The axis of the first shaft begins across both, that of the second in their plane.
        const double expected = std::atan2(std::sin(first) * std::cos(b), std::cos(first));
        ASSERT_LT(std::abs(std::remainder(second - expected, 2.0 * kPi)), glm::radians(0.5))
            << frame << " " << first << " " << second;
    }
}

TEST(Joints, RodsKeepTheirLength) {
    Scene scene = rigid_scene();
    scene.objects = {rigid("ball", SphereShape{0.05}, {0.6, 0.8, 0.0})};
    scene.attachments = {{.object = "ball", .where = AttachedDistance{{0.6, 0.8, 0.0}, {0.0, 1.6, 0.0}}}};
    MeasuredRun run(scene);
    const double energy = run.energy();
    for (int frame = 0; frame < 600; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_NEAR(run.joint(0).position, 1.0, 1e-3) << frame;
        ASSERT_LT(run.energy(), energy + 1e-3 * run.mass(0) * kGravity) << frame;
    }
    EXPECT_GT(run.energy(), energy - 0.02 * run.mass(0) * kGravity * 0.2);
}

// A soft ball on a rope swings in a circle, and a rope between two soft ones pulls both.
TEST(Joints, RopesHoldSoftBodies) {
    Scene scene = rigid_scene();
    scene.materials[0].youngs_modulus = 1e5;
    scene.objects = {rigid("upper", SphereShape{0.1, 4}, {0.0, 0.0, 0.0}),
                     rigid("lower", SphereShape{0.1, 4}, {0.3, -0.2, 0.0})};
    for (ObjectDescription& object : scene.objects) object.rigid.reset();
    scene.attachments = {{.object = "upper", .where = AttachedDistance{{0.0, 0.0, 0.0}, {0.0, 0.6, 0.0}}},
                         {.object = "lower",
                          .to = "upper",
                          .where = AttachedDistance{{0.3, -0.2, 0.0}, {0.0, 0.0, 0.0}},
                          .limits = {{0.0, 0.5}}}};
    MeasuredRun run(scene);
    const double energy = run.energy();
    double least = 1.0;
    for (int frame = 0; frame < 240; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_NEAR(run.joint(0).position, 0.6, 0.01) << frame;
        ASSERT_LT(run.joint(1).position, 0.51) << frame;
        ASSERT_LT(run.energy(), energy + 0.01 * run.mass(0) * kGravity * 0.5) << frame;
        least = std::min(least, run.joint(1).position);
    }
    EXPECT_LT(least, 0.45);  // it was slack
}

// Bodies at a distance meet, as if nothing were between them.
TEST(Joints, WhatIsAtADistanceMeets) {
    Scene scene = rigid_scene();
    add_floor(scene);
    scene.objects = {rigid_box("lower", {0.4, 0.2, 0.4}, {0.0, 0.102, 0.0}),
                     rigid_box("upper", {0.2, 0.2, 0.2}, {0.0, 0.6, 0.0})};
    scene.attachments = {{.object = "upper",
                          .to = "lower",
                          .where = AttachedDistance{{0.0, 0.6, 0.0}, {0.0, 0.102, 0.0}},
                          .limits = {{0.0, 0.6}}}};
    MeasuredRun run(scene);
    run.advance(1.5);
    EXPECT_NEAR(run.center(1).y, 0.3, 0.01);
    EXPECT_EQ(run.overlaps(), 0u);
}

// A door that overlaps its post, a collider, at the hinge.
TEST(Joints, WhatIsJoinedMayOverlap) {
    Scene scene = rigid_scene();
    ColliderDescription post;
    post.name = "post";
    post.shape = BoxShape{{0.2, 2.0, 0.2}};
    scene.colliders = {post};
    scene.objects = {rigid_box("door", {1.0, 1.0, 0.05}, {0.55, 0.0, 0.0})};
    scene.attachments = {{.object = "door",
                          .to = "post",
                          .where = AttachedLine{{0.08, -0.5, 0.0}, {0.08, 0.5, 0.0}},
                          .motor = JointMotor{.speed = 60.0}}};
    MeasuredRun run(scene);
    run.advance(1.5);
    EXPECT_NEAR(run.joint(0).position, kPi / 2.0, 0.01);
}

// What rests with a motor that holds still sleeps, and wakes when it has to move.
TEST(Joints, SleepUntilAMotorMoves) {
    Scene scene = bar_on_hinge({0.0, -kGravity, 0.0});
    add_floor(scene);
    scene.colliders[0].shape = PlaneCollider{{0.0, 1.0, 0.0}, -0.4};
    scene.attachments[0].motor = JointMotor{.speed = 0.0, .keyframes = {{.time = 2.0, .speed = 45.0}}};
    MeasuredRun run(scene);
    run.advance(1.9);
    EXPECT_EQ(run.fastest(0), 0.0);
    EXPECT_NEAR(run.joint(0).effort, 0.5 * kGravity, 0.005 * kGravity);
    run.advance(1.1);
    EXPECT_NEAR(run.joint(0).position, kPi / 4.0, 0.02);
}

TEST(Joints, GoOnFromACheckpoint) {
    Scene scene = bar_on_hinge({0.0, -kGravity, 0.0});
    scene.attachments[0].motor = JointMotor{.speed = 45.0, .position = 60.0, .force = 6.0};
    MeasuredRun run(scene), again(scene);
    run.advance(0.5);
    const auto file = std::filesystem::temp_directory_path() / "gelatin_joint_checkpoint";
    run.simulator().save_checkpoint(file);
    again.simulator().load_checkpoint(file);
    std::filesystem::remove(file);
    run.advance(1.0);
    again.advance(1.0);
    const auto positions = run.simulator().positions(), others = again.simulator().positions();
    EXPECT_TRUE(std::equal(positions.begin(), positions.end(), others.begin(), others.end()));
    EXPECT_EQ(run.joint(0).effort, again.joint(0).effort);
}

TEST(Joints, BreakWhereTheyCarryTooMuch) {
    Scene scene = box_on_rail({1.0, 0.0, 0.0}, {0.0, -kGravity, 0.0});
    scene.attachments[0].break_force = 0.9 * kGravity;
    MeasuredRun run(scene);
    run.advance(0.5);
    EXPECT_TRUE(run.is_broken(0));
    EXPECT_LT(run.center(0).y, -1.0);
}

TEST(Joints, KeepMomenta) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    scene.objects = {rigid_box("body", {0.5, 0.2, 0.3}, {0.0, 0.0, 0.0}),
                     rigid_box("wheel", {0.3, 0.3, 0.05}, {0.0, 0.0, 0.8}),
                     rigid_box("slide", {0.1, 0.1, 0.1}, {0.4, 0.0, 0.0}),
                     rigid_box("shaft", {0.1, 0.4, 0.1}, {0.0, 0.4, 0.0}),
                     rigid_box("tail", {0.1, 0.1, 0.1}, {-0.8, 0.0, 0.0})};
    scene.objects[0].spin = {40.0, 100.0, 20.0};
    scene.objects[4].velocity = {-0.5, 1.0, 0.0};
    scene.attachments = {
        {.object = "wheel", .to = "body", .where = AttachedLine{{0.0, 0.0, 0.7}, {0.0, 0.0, 0.9}}},
        {.object = "slide", .to = "body", .where = AttachedRail{{0.4, 0.0, 0.0}, {1.0, 0.0, 0.0}}},
        {.object = "shaft",
         .to = "body",
         .where = AttachedUniversal{{0.0, 0.15, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}},
        {.object = "tail", .to = "body", .where = AttachedDistance{{-0.75, 0.0, 0.0}, {-0.25, 0.0, 0.0}}}};
    scene.attachments[0].motor = JointMotor{.speed = 1000.0, .force = 20.0};
    scene.attachments[1].spring = JointSpring{.stiffness = 30.0, .damping = 0.5, .rest = 0.2};
    MeasuredRun run(scene);
    const glm::dvec3 momentum = run.momentum(), angular = run.angular_momentum();
    run.advance(4.0);
    EXPECT_LT(glm::distance(run.momentum(), momentum), 1e-4 * glm::length(momentum));
    EXPECT_LT(glm::distance(run.angular_momentum(), angular), 1e-5 * glm::length(angular));
    EXPECT_NEAR(run.joint(0).speed, glm::radians(1000.0), 0.01 * glm::radians(1000.0));
    EXPECT_NEAR(run.joint(3).position, 0.5, 5e-3);
}

}  // namespace
}  // namespace gelatin::joint_test
