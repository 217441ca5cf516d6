// Rigid bodies against closed forms: how they move, swing, slide, stand and hang, by themselves and with soft
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "gelatin/simulator.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::rigid_body_test {
namespace {

using namespace test;

TEST(RigidBodies, TumbleWithoutLoss) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    scene.objects = {rigid_box("box", {1.0, 0.2, 0.5}, {0.5, 1.0, 0.0})};
    scene.objects[0].velocity = {0.3, 0.0, 0.1};
    scene.objects[0].spin = {10.0, 5.0, 360.0};  // nearly about the axis about which it cannot
    MeasuredRun run(scene);
    const double energy = run.energy();
    const glm::dvec3 angular = run.angular_momentum();
    run.advance(10.0);
    EXPECT_NEAR(run.energy(), energy, 2e-3 * energy);
    EXPECT_LT(glm::distance(run.angular_momentum(), angular), 1e-4 * glm::length(angular));
    EXPECT_LT(glm::distance(run.center(0), {3.5, 1.0, 1.0}), 1e-4);
    EXPECT_LT(run.strain(0), 1e-5);
}

TEST(RigidBodies, SlideAndHoldByFriction) {
    const auto on_slope = [](double part) {  // of the slope that friction holds
        const double friction = 0.4, angle = std::atan(friction * part);
        Scene scene = rigid_scene(friction, kGravity * glm::dvec3(std::sin(angle), -std::cos(angle), 0.0));
        add_floor(scene, friction);
        scene.objects = {rigid_box("box", {0.4, 0.2, 0.4}, {0.0, 0.1015, 0.0})};
        MeasuredRun run(scene);
        run.advance(1.0);
        const double before = run.velocity(0).x;
        run.advance(1.0);
        return (run.velocity(0).x - before) / (kGravity * (std::sin(angle) - friction * std::cos(angle)));
    };
    EXPECT_NEAR(on_slope(1.3), 1.0, 0.01);
    EXPECT_NEAR(on_slope(0.98), 0.0, 1e-4);
}

TEST(RigidBodies, SwingWithTheirPeriod) {
    Scene scene = rigid_scene();
    scene.objects = {rigid_box("bar", {0.1, 1.0, 0.1}, {0.0, -0.5, 0.0})};
    scene.objects[0].spin = {0.0, 0.0, 12.0};
    scene.objects[0].velocity = {glm::radians(12.0) * 0.5, 0.0, 0.0};
    scene.attachments = {{.object = "bar", .where = AttachedLine{{0.0, 0.0, -0.05}, {0.0, 0.0, 0.05}}}};
    MeasuredRun run(scene);
    const double inertia = (0.01 + 1.0) / 12.0 + 0.25;  // of 1 kg, about the hinge
    const double period = 2.0 * std::numbers::pi * std::sqrt(inertia / (kGravity * 0.5));
    const double energy = run.energy();
    std::vector<double> crossings;  // to the right
    for (double before = 0.0; crossings.size() < 6;) {
        run.advance(1.0 / 60.0);
        const double now = run.center(0).x;
        if (before < 0.0 && now >= 0.0)
            crossings.push_back(run.simulator().time() - now / (now - before) / 60.0);
        before = now;
        ASSERT_LT(run.simulator().time(), 20.0);
    }
    EXPECT_NEAR((crossings.back() - crossings.front()) / 5.0, period, 0.01 * period);
    const double scale = kGravity * run.mass(0) * 0.5 * (1.0 - std::cos(0.1));
    EXPECT_LT(run.energy() - energy, 1e-3 * scale);
    EXPECT_GT(run.energy() - energy, -2e-3 * scale);
    EXPECT_NEAR(glm::length(run.center(0)), 0.5, 1e-3);
}

TEST(RigidBodies, PrecessAsTopsDo) {
    Scene scene = rigid_scene();
    const double arm = 0.2, spin = 60.0;
    scene.objects = {rigid_box("disc", {0.05, 0.2, 0.2}, {arm, 1.0, 0.0})};
    const double axial = 0.04 / 6.0, rate = kGravity * arm / (axial * spin);  // of 1 kg; its axis is level
    scene.objects[0].spin = glm::degrees(glm::dvec3(spin, rate, 0.0));
    scene.objects[0].velocity = {0.0, 0.0, -rate * arm};
    scene.attachments = {{.object = "disc", .where = AttachedPoint{{0.0, 1.0, 0.0}}}};
    MeasuredRun run(scene);
    double turned = 0.0;
    for (int frame = 0; frame < 120; ++frame) {
        const glm::dvec3 before = run.center(0);
        run.advance(1.0 / 60.0);
        const glm::dvec3 now = run.center(0);
        turned += std::atan2(before.z * now.x - before.x * now.z, before.x * now.x + before.z * now.z);
        ASSERT_NEAR(now.y, 1.0, 0.05 * arm) << frame;
    }
    EXPECT_NEAR(turned / 2.0, rate, 0.01 * rate);
}

// Points of a catenary at equal lengths of it, from one support to the other at the same height.
std::vector<glm::dvec3> catenary(double length, double span, std::size_t links, double& parameter) {
    double low = 0.05 * span, high = 100.0 * span;
    for (int k = 0; k < 200; ++k) {
        parameter = 0.5 * (low + high);
        (2.0 * parameter * std::sinh(0.5 * span / parameter) > length ? low : high) = parameter;
    }
    std::vector<glm::dvec3> points;
    for (std::size_t k = 0; k <= links; ++k) {
        const double s = length * (static_cast<double>(k) / static_cast<double>(links) - 0.5);
        const double x = parameter * std::asinh(s / parameter);
        points.emplace_back(x, parameter * (std::cosh(x / parameter) - std::cosh(0.5 * span / parameter)),
                            0.0);
    }
    return points;
}

TEST(RigidBodies, ChainsHangAsACatenary) {
    constexpr std::size_t kLinks = 50;
    constexpr double kLength = 10.0, kThick = 0.05;
    double parameter = 0.0;
    const std::vector<glm::dvec3> points = catenary(kLength, 6.0, kLinks, parameter);
    Scene scene = rigid_scene();
    for (std::size_t k = 0; k < kLinks; ++k) {
        const glm::dvec3 along = points[k + 1] - points[k];
        ObjectDescription link =
            rigid_box("link " + std::to_string(k), {0.8 * glm::length(along), kThick, kThick},
                      0.5 * (points[k] + points[k + 1]));
        link.rotation.z = glm::degrees(std::atan2(along.y, along.x));
        link.rigid->mass = 1.0;
        scene.objects.push_back(link);
        scene.attachments.push_back({.object = link.name,
                                     .to = k == 0 ? "" : scene.objects[k - 1].name,
                                     .where = AttachedPoint{points[k]}});
    }
    scene.attachments.push_back(
        {.object = scene.objects.back().name, .where = AttachedPoint{points[kLinks]}});
    MeasuredRun run(scene);
    run.advance(2.0);
    const double weight = kGravity * kLinks, level = weight / kLength * parameter;
    glm::dvec3 mean(0.0);
    for (int frame = 0; frame < 60; ++frame) {
        run.advance(1.0 / 60.0);
        mean += run.force(0) / 60.0;
    }
    EXPECT_NEAR(mean.x, -level, 0.01 * level);
    EXPECT_NEAR(mean.y, 0.5 * weight, 0.01 * weight);
    for (std::size_t k = 0; k < kLinks; ++k) {
        const double apart = k == 0 ? 0.0 : glm::distance(run.center(k), run.center(k - 1));
        const double at_first =
            k == 0 ? 0.0 : glm::distance(scene.objects[k].position, scene.objects[k - 1].position);
        EXPECT_NEAR(apart, at_first, 0.01 * kLength / kLinks) << k;
        EXPECT_LT(glm::distance(run.center(k), scene.objects[k].position), 0.01 * kLength) << k;
        EXPECT_LT(run.fastest(k), 0.02) << k;
    }
}

TEST(RigidBodies, LightOnesHoldAThousandTimesTheirMass) {
    Scene scene = rigid_scene();
    for (int k = 0; k < 5; ++k) {
        ObjectDescription link =
            rigid_box("link " + std::to_string(k), {0.04, 0.18, 0.04}, {0.0, -0.1 - 0.2 * k, 0.0});
        link.rigid->mass = 0.2;
        scene.objects.push_back(link);
        scene.attachments.push_back({.object = link.name,
                                     .to = k == 0 ? "" : scene.objects[static_cast<std::size_t>(k) - 1].name,
                                     .where = AttachedPoint{{0.0, -0.2 * k, 0.0}}});
    }
    ObjectDescription load = rigid_box("load", {0.4, 0.4, 0.4}, {0.0, -1.25, 0.0});
    load.rigid->mass = 200.0;
    load.velocity = {0.5, 0.0, 0.0};
    scene.objects.push_back(load);
    scene.attachments.push_back({.object = "load", .to = "link 4", .where = AttachedPoint{{0.0, -1.0, 0.0}}});
    MeasuredRun run(scene);
    const double energy = run.energy();
    double most = 0.0;
    for (int frame = 0; frame < 300; ++frame) {
        run.advance(1.0 / 60.0);
        most = std::max(most, glm::length(run.center(5)));
        ASSERT_LT(run.energy() - energy, 0.02 * 0.5 * 200.0 * 0.25) << frame;
    }
    EXPECT_LT(most, 1.01 * 1.25);
    EXPECT_GT(most, 1.24);
}

TEST(RigidBodies, TwentyInAStackComeToRest) {
    Scene scene = rigid_scene();
    add_floor(scene);
    for (int k = 0; k < 20; ++k)
        scene.objects.push_back(
            rigid_box("box " + std::to_string(k), {0.4, 0.2, 0.4}, {0.0, 0.102 + 0.202 * k, 0.0}));
    MeasuredRun run(scene);
    run.advance(3.0);
    for (std::size_t o = 0; o < 20; ++o) {
        EXPECT_EQ(run.fastest(o), 0.0) << o;  // asleep
        EXPECT_NEAR(run.center(o).x, 0.0, 0.01) << o;
        EXPECT_NEAR(run.center(o).z, 0.0, 0.01) << o;
    }
    EXPECT_NEAR(run.center(19).y, 0.1 + 0.2 * 19 + 20 * 0.003, 0.005);  // with gaps below reaches of 3.2 mm
    const auto forces = run.statistics().contact_forces;
    double pressed = 0.0;
    for (const ContactForce& force : forces)
        if (force.object == 0 && force.collider) pressed = force.normal[1];
    EXPECT_NEAR(pressed, 20.0 * kGravity * run.mass(0), 0.01 * 20.0 * kGravity * run.mass(0));
}

TEST(RigidBodies, LieOnSoftOnes) {
    Scene scene = rigid_scene();
    add_floor(scene);
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].name = "jelly";
    scene.materials[1].youngs_modulus = 5e4;
    scene.materials[1].damping = 0.05;
    ObjectDescription mattress = rigid("mattress", BoxShape{{1.0, 0.4, 1.0}, {6, 3, 6}}, {0.0, 0.205, 0.0});
    mattress.rigid.reset();
    mattress.material = "jelly";
    scene.objects = {mattress, rigid_box("crate", {0.4, 0.4, 0.4}, {0.0, 0.65, 0.0})};
    MeasuredRun run(scene);
    run.advance(4.0);
    EXPECT_LT(run.fastest(1), 0.01);
    double pressed = 0.0;
    for (const ContactForce& force : run.statistics().contact_forces)
        if (force.other == 1u) pressed = std::abs(force.normal[1]);
    EXPECT_NEAR(pressed, kGravity * run.mass(1), 0.01 * kGravity * run.mass(1));
    EXPECT_LT(run.center(1).y, 0.62);
    EXPECT_EQ(run.overlaps(), 0u);
}

TEST(RigidBodies, KeepMomentaWhenTheyMeet) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].name = "jelly";
    ObjectDescription ball = rigid("ball", SphereShape{0.2, 4}, {0.0, 0.55, 0.05});
    ball.rigid.reset();
    ball.material = "jelly";
    ball.velocity = {0.0, -3.0, 0.0};
    scene.objects = {rigid_box("bar", {1.0, 0.1, 0.2}, {0.2, 0.0, 0.0}), ball,
                     rigid_box("other", {0.3, 0.2, 0.2}, {0.5, -0.3, 0.0})};
    MeasuredRun run(scene);
    const glm::dvec3 momentum = run.momentum(), angular = run.angular_momentum();
    const double energy = run.energy();
    for (int frame = 0; frame < 120; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_EQ(run.overlaps(), 0u) << frame;
        ASSERT_LT(run.energy(), 1.002 * energy) << frame;
    }
    EXPECT_LT(glm::distance(run.momentum(), momentum), 1e-4 * glm::length(momentum));
    EXPECT_LT(glm::distance(run.angular_momentum(), angular), 2e-3 * glm::length(momentum));
    EXPECT_GT(std::abs(run.center(2).y + 0.3), 0.01);  // it was hit
}

// Of a face, whose pairs the guard may clip, as of a plane.
TEST(RigidBodies, LeaveFacesAndPlanesByTheirRestitution) {
    ColliderDescription box, plane;
    box.shape = Shape{BoxShape{{0.1, 1.0, 1.0}}};
    box.position = {0.6, 0.0, 0.0};
    plane.shape = PlaneCollider{{-1.0, 0.0, 0.0}, -0.55};
    for (const ColliderDescription& wall : {box, plane}) {
        for (const double restitution : {0.5, 1.0}) {
            for (const double speed : {2.0, 10.0, 40.0}) {
                Scene scene = rigid_scene(0.0, glm::dvec3(0.0));
                scene.objects = {rigid_box("die", glm::dvec3(0.1), {0.0, 0.0, 0.0})};
                scene.objects[0].velocity = {speed, 0.0, 0.0};
                scene.colliders = {wall};
                scene.colliders[0].restitution = restitution;
                MeasuredRun run(scene);
                run.advance(0.7);
                EXPECT_NEAR(run.velocity(0).x, -restitution * speed, 0.01 * speed)
                    << restitution << ' ' << speed;
            }
        }
    }
}

// From level, without and with a load of several hundred times a link's mass: they fold and whip, and links
// that are not neighbours hit each other.
TEST(RigidBodiesHeavy, ChainsThatFallGainNoEnergyAndDoNotStretch) {
    for (const auto& [links, load] : {std::pair(50u, 0.0), std::pair(10u, 200.0)}) {
        Scene scene = rigid_scene();
        const auto add = [&](const ObjectDescription& object, double joint) {
            scene.attachments.push_back({.object = object.name,
                                         .to = scene.objects.empty() ? "" : scene.objects.back().name,
                                         .where = AttachedPoint{{joint, 0.0, 0.0}}});
            scene.objects.push_back(object);
        };
        for (unsigned k = 0; k < links; ++k)
            add(rigid_box("link " + std::to_string(k), {0.18, 0.04, 0.04}, {0.2 * k + 0.1, 0.0, 0.0}),
                0.2 * k);
        double scale = kGravity * 0.288 * links * 0.1 * links;  // as its middle falls by its height
        if (load > 0.0) {
            ObjectDescription weight = rigid_box("load", {0.3, 0.3, 0.3}, {0.2 * links + 0.16, 0.0, 0.0});
            weight.rigid->mass = load;
            add(weight, 0.2 * links);
            scale += kGravity * load * 0.2 * links;
        }
        MeasuredRun run(scene);
        const double energy = run.energy();
        for (int frame = 0; frame < 360; ++frame) {
            run.advance(1.0 / 60.0);
            // Taut links, which tension turns back, do not shake.
            for (unsigned k = 0; load > 0.0 && k < links; ++k)
                ASSERT_LT(run.fastest(k), 1.3 * std::sqrt(2.0 * kGravity * 0.2 * links))
                    << k << " in " << frame;
            ASSERT_LT(run.energy(), energy + 0.01 * scale) << links << " links, frame " << frame;
            for (unsigned k = 1; k < links; ++k)
                ASSERT_LT(glm::distance(run.center(k), run.center(k - 1)), 1.03 * 0.2)
                    << k << " in " << frame;
        }
    }
}

// Of any shape, thrown at each other and at soft ones.
TEST(RigidBodiesHeavy, NeverPassThroughAnything) {
    Scene scene = rigid_scene();
    add_floor(scene);
    for (int k = 0; k < 24; ++k) {
        const glm::dvec3 at(0.6 * (k % 3) - 0.6, 0.6 + 0.6 * (k / 6), 0.6 * (k / 3 % 2) - 0.3);
        const Shape shape = k % 4 == 0   ? Shape(TextShape{"S", 0.15, 0.5})
                            : k % 4 == 1 ? Shape(BoxShape{{0.4, 0.1, 0.3}})
                            : k % 4 == 2 ? Shape(CapsuleShape{0.1, 0.2, 3})
                                         : Shape(SphereShape{0.18, 3});
        ObjectDescription object = rigid("body " + std::to_string(k), shape, at);
        object.rotation = {37.0 * k, 61.0 * k, 0.0};
        object.velocity = 25.0 * glm::normalize(glm::dvec3(0.3, 0.4, 0.0) - at) * (k % 5 == 0 ? 2.0 : 1.0);
        object.spin = {300.0 * (k % 3), -200.0 * (k % 7), 0.0};
        if (k % 3 == 2) object.rigid.reset();
        scene.objects.push_back(object);
    }
    MeasuredRun run(scene);
    for (int frame = 0; frame < 90; ++frame) {
        run.advance(1.0 / 60.0);
        ASSERT_EQ(run.overlaps(), 0u) << frame;
        for (const ModelObject& object : run.model().bodies())
            for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f)
                ASSERT_GE(run.simulator().positions()[run.model().faces[f].a].y, 0.0f) << frame;
    }
    for (std::size_t o = 0; o < 24; ++o) {
        if (!run.model().objects[o].is_rigid) continue;
        EXPECT_LT(run.strain(o), 1e-4) << o;
    }
}

}  // namespace
}  // namespace gelatin::rigid_body_test
