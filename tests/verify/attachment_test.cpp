// Attachments against closed forms: what they carry, how they swing and yield, when they break, and what they
// keep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gelatin/error.h"
#include "gelatin/simulator.h"
#include "support/gl_fixture.h"
#include "verify/support/attached_boxes.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::attachment_test {
namespace {

using namespace test;

TEST(Attachments, CarryWhatHangsOnThem) {
    MeasuredRun run(hanging_row());
    run.advance(8.0);
    double weight = 0.0;
    for (const std::size_t object : {2u, 1u, 0u}) {
        weight += run.mass(object) * kGravity;
        EXPECT_LT(glm::distance(run.force(object), {0.0, weight, 0.0}), 0.01 * weight) << object;
    }
    EXPECT_EQ(run.overlaps(), 0u);
}

// Stiff ties to what never moves neither keep bodies trembling nor take what they swing with.
TEST(Attachments, WhatHangsComesToRestByItsDampersAlone) {
    MeasuredRun damped(hanging_row());
    damped.advance(4.0);
    for (std::size_t object = 0; object < 3; ++object) EXPECT_LT(damped.fastest(object), 1e-5) << object;
    Scene scene = hanging_row();
    scene.materials[0].damping = 0.0;
    MeasuredRun free(scene);
    double early = 0.0, late = 0.0;
    for (int k = 0; k < 240; ++k) {
        free.advance(1.0 / 60.0);
        double& most = k < 60 ? early : late;
        if (k < 60 || k >= 180) most = std::max(most, free.statistics().kinetic_energy);
    }
    EXPECT_GT(late, 0.2 * early);
}

// Parts that are glued together bend as one that was never cut.
TEST(Attachments, HalvesOfABeamBendAsTheWhole) {
    const auto tip_of = [](bool is_cut) {
        Scene scene = scene_of(jelly(4e6, 0.1));
        scene.materials[0].model = MaterialModel::neo_hookean;  // springs depend more on the mesh
        const double length = 0.8;
        scene.objects = {box("a", {is_cut ? 0.5 * length : length, 0.2, 0.2},
                             {is_cut ? 0.25 * length : 0.5 * length, 0, 0}, is_cut ? 700 : 1400)};
        scene.objects[0].pins = {HalfSpaceRegion{{1, 0, 0}, 1e-3}};
        if (is_cut) {
            scene.objects.push_back(box("b", {0.5 * length, 0.2, 0.2}, {0.75 * length + 0.006, 0, 0}, 700));
            scene.attachments = {{.object = "b", .to = "a"}};
        }
        MeasuredRun run(scene);
        run.advance(6.0);
        double lowest = 0.0;
        for (const glm::vec4& p : run.simulator().positions()) lowest = std::min(lowest, double(p.y));
        return lowest;
    };
    const double whole = tip_of(false), glued = tip_of(true);
    EXPECT_LT(whole, -0.13);  // of which 0.1 is where it starts
    // Longer by the gap, 0.75%, it bends by 3% more; and what carries ties has a mesh of its own.
    EXPECT_NEAR(glued, whole, 0.1 * std::abs(whole + 0.1));
}

// T = 2 pi sqrt(I / (m g d)), of a stiff plate on a hinge along its upper edge.
TEST(Attachments, APlateSwingsOnAHinge) {
    Scene scene = scene_of(jelly(5e7));
    const double height = 0.4, width = 0.3, depth = 0.1;
    scene.objects = {box("plate", {width, height, depth}, {0.0, 0.0, 0.0})};
    // By 3 degrees aside, about the hinge.
    const double angle = 3.0;
    scene.objects[0].rotation = {angle, 0.0, 0.0};
    const double a = angle * std::numbers::pi / 180.0;
    const glm::dvec3 top(0.0, 0.5 * height * std::cos(a), 0.5 * height * std::sin(a));
    scene.attachments = {
        {.object = "plate",
         .where = AttachedLine{top - glm::dvec3(0.5 * width, 0, 0), top + glm::dvec3(0.5 * width, 0, 0)}}};
    scene.simulation.frame_rate = 240.0;
    MeasuredRun run(scene);
    const double start = run.center(0).z - top.z;
    std::vector<double> crossings;
    double before = start;
    while (crossings.size() < 5 && run.simulator().time() < 10.0) {
        run.simulator().advance_frame();
        const double now = run.center(0).z - top.z;
        if ((before < 0.0) != (now < 0.0))
            crossings.push_back(run.simulator().time() - now / (now - before) / 240.0);
        before = now;
    }
    ASSERT_EQ(crossings.size(), 5u);
    const double d = 0.5 * height, inertia = (height * height + depth * depth) / 12.0 + d * d;
    const double period = 2.0 * std::numbers::pi * std::sqrt(inertia / (kGravity * d));
    EXPECT_NEAR(0.5 * (crossings[4] - crossings[0]), period, 0.01 * period);
}

// A door on a post that is held at its foot swings freely.
TEST(Attachments, ADoorOnAPostKeepsItsSwing) {
    Scene scene = scene_of(jelly(2e7), 0.0);
    scene.objects = {box("post", {0.12, 1.7, 0.12}, {-0.97, 0.85, 0.0}),
                     box("door", {0.82, 1.1, 0.06}, {-0.42, 1.0, 0.0})};
    scene.objects[0].shape = BoxShape{{0.12, 1.7, 0.12}, {1, 12, 1}};
    scene.objects[1].shape = BoxShape{{0.82, 1.1, 0.06}, {7, 9, 1}};
    for (ObjectDescription& object : scene.objects) object.mesher = {};
    scene.objects[0].pins = {HalfSpaceRegion{{0.0, 1.0, 0.0}, 0.01}};
    scene.objects[1].spin = {0.0, 1.0, 0.0};
    scene.objects[1].velocity = {0.0, 0.0, -0.41};
    const glm::dvec3 foot(-0.83, 0.5, 0.0), head(-0.83, 1.5, 0.0);
    scene.attachments = {{.object = "door", .to = "post", .where = AttachedLine{foot, head}}};
    MeasuredRun run(scene);
    run.advance(0.2);
    const double early = run.statistics().kinetic_energy;
    run.advance(1.0);
    EXPECT_GT(run.statistics().kinetic_energy, 0.97 * early);
}

// F = x / C.
TEST(Attachments, YieldByTheirCompliance) {
    Scene scene = scene_of(jelly(1e6, 0.2));
    scene.objects = {box("cube", {0.2, 0.2, 0.2}, {0.0, 0.0, 0.0})};
    const double weight = 8.0 * kGravity, compliance = 0.1 / weight;
    scene.attachments = {{.object = "cube", .where = above(0.09), .compliance = compliance}};
    MeasuredRun run(scene);
    const double stiff = [&] {
        Scene other = scene;
        other.attachments[0].compliance = 0.0;
        MeasuredRun held(other);
        held.advance(6.0);
        return held.center(0).y;
    }();
    // It swings about where it would rest: on average over ten times T = 2 pi sqrt(m C), after a while.
    const double extension = compliance * run.mass(0) * kGravity;
    run.advance(2.0);
    double sum = 0.0;
    const int frames = static_cast<int>(600.0 * 2.0 * std::numbers::pi * std::sqrt(run.mass(0) * compliance));
    for (int k = 0; k < frames; ++k) {
        run.simulator().advance_frame();
        sum += run.center(0).y / frames;
    }
    EXPECT_NEAR(stiff - sum, extension, 0.02 * extension);
}

TEST(Attachments, BreakWhereTheyCarryTooMuch) {
    for (const bool breaks : {false, true}) {
        Scene scene = hanging_row();
        // Hung softly, so that the load rises slowly to twice the weight.
        scene.attachments[2].break_force = (breaks ? 0.9 : 2.5) * 8.0 * kGravity;
        MeasuredRun run(scene);
        run.advance(2.0);
        EXPECT_EQ(run.is_broken(2), breaks);
        EXPECT_FALSE(run.is_broken(1));
        EXPECT_EQ(run.center(2).y < -1.0, breaks) << run.center(2).y;
        if (breaks) {
            EXPECT_GE(glm::length(run.force(2)), 0.9 * 8.0 * kGravity);
            run.simulator().reset();
            EXPECT_FALSE(run.is_broken(2));
        }
    }
}

// What is attached flies as one: nothing is lost or gained. @param at of a joint; none: all is glued
void expect_kept(std::optional<glm::dvec3> joint) {
    Scene scene = scene_of(jelly(1e5), 0.0);
    scene.objects = {box("a", {0.3, 0.2, 0.2}, {-0.153, 0.0, 0.0}),
                     box("b", {0.3, 0.2, 0.2}, {0.153, 0.0, 0.0}),
                     box("c", {0.1, 0.1, 0.1}, {-0.1, joint ? 0.2 : 0.155, 0.0})};
    scene.objects[0].velocity = {0.5, -1.0, 0.3};
    scene.objects[1].velocity = {0.1, 1.0, 0.3};
    scene.attachments = {{.object = "b", .to = "a"}, {.object = "c", .to = "a"}};
    if (joint) scene.attachments[1].where = AttachedPoint{*joint};
    MeasuredRun run(scene);
    const glm::dvec3 p = run.momentum(), l = run.angular_momentum();
    const double start = run.energy();
    double most = start;
    for (int k = 0; k < 30; ++k) {
        run.advance(0.1);
        most = std::max(most, run.energy());
    }
    EXPECT_LT(glm::distance(run.momentum(), p), 1e-5 * 25.0);
    EXPECT_LT(glm::distance(run.angular_momentum(), l), 1e-5 * glm::length(l));
    EXPECT_LT(most, 1.002 * start);
    EXPECT_GT(run.energy(), 0.5 * start);
    EXPECT_EQ(run.overlaps(), 0u);
}

TEST(Attachments, KeepMomentumAndAngularMomentum) {
    expect_kept({});
}

TEST(Attachments, KeepMomentumWhereBodiesSwing) {
    expect_kept(glm::dvec3(-0.1, 0.13, 0.0));
}

TEST(Attachments, ALightBodyCarriesAThousandTimesItsMass) {
    Scene scene = scene_of(jelly(1e6, 0.1));
    Material heavy = jelly(1e7, 0.1);
    heavy.name = "lead";
    heavy.density = 11000.0;
    scene.materials.push_back(heavy);
    scene.materials[0].density = 100.0;
    scene.objects = {box("rope", {0.05, 0.3, 0.05}, {0.0, 0.0, 0.0}),
                     box("load", {0.19, 0.19, 0.19}, {0.0, -0.248, 0.0})};
    scene.objects[1].material = "lead";
    scene.attachments = {{.object = "rope", .where = above(0.149)}, {.object = "rope", .to = "load"}};
    MeasuredRun run(scene);
    ASSERT_GT(run.mass(1), 990.0 * run.mass(0));
    const double apart = run.center(0).y - run.center(1).y;
    run.advance(6.0);
    const double weight = run.mass(1) * kGravity;
    EXPECT_NEAR(run.force(0).y, weight, 0.02 * weight);
    // E A e, by half of the rope between its centre and the load's.
    const double stretch = weight / (1e6 * 0.05 * 0.05) * 0.15;
    EXPECT_NEAR(run.center(0).y - run.center(1).y - apart, stretch, 0.2 * stretch);
}

// A ball glued to a collider goes with it, and leaves it when it is let go.
TEST(Attachments, FollowCollidersAndAreCut) {
    Scene scene = scene_of(jelly(1e5, 0.05));
    scene.objects = {box("cube", {0.2, 0.2, 0.2}, {0.0, -0.206, 0.0})};
    ColliderDescription lift;
    lift.name = "lift";
    lift.shape = BoxShape{{0.4, 0.2, 0.4}};
    lift.keyframes = {{0.0}, {2.0, {0.5, 0.5, 0.0}, {0.0, 90.0, 0.0}}};
    scene.colliders = {lift};
    scene.attachments = {{.object = "cube", .to = "lift"}};
    MeasuredRun run(scene);
    run.advance(4.0);
    EXPECT_NEAR(run.center(0).x, 0.5, 0.01);
    EXPECT_NEAR(run.center(0).y, 0.29, 0.02);
    EXPECT_NEAR(run.force(0).y, run.mass(0) * kGravity, 0.03 * run.mass(0) * kGravity);
    EXPECT_EQ(run.overlaps(), 0u);
    run.simulator().detach(0);
    run.advance(1.0);
    EXPECT_LT(run.center(0).y, -2.0);
    EXPECT_THROW(run.simulator().detach(1), InvalidInput);
}

// To a plane, a collider that rests, and nothing but a place.
TEST(Attachments, HangOnWhatNeverMoves) {
    for (const char* to : {"ceiling", "plate", ""}) {
        Scene scene = scene_of(jelly(1e5, 0.1));
        scene.simulation.sleep = false;  // it would begin while forces still change by 3%
        scene.objects = {box("cube", {0.2, 0.2, 0.2}, {0.0, -0.106, 0.0})};
        ColliderDescription ceiling;
        ceiling.name = to;
        if (std::string_view(to) == "plate") {
            ceiling.shape = BoxShape{{0.4, 0.2, 0.4}};
            ceiling.position = {0.0, 0.1, 0.0};
        } else {
            ceiling.shape = PlaneCollider{{0.0, -1.0, 0.0}};
        }
        scene.colliders = {ceiling};
        scene.attachments = {{.object = "cube", .to = to}};
        if (std::string_view(to).empty()) scene.attachments[0].where = above(-0.01);
        MeasuredRun run(scene);
        run.advance(5.0);
        const double weight = run.mass(0) * kGravity;
        EXPECT_GT(run.center(0).y, -0.13) << to;
        EXPECT_LT(glm::distance(run.force(0), {0.0, weight, 0.0}), 0.02 * weight) << to;
        EXPECT_EQ(run.overlaps(), 0u) << to;
    }
}

TEST(Attachments, AreMadeWhileRunning) {
    Scene scene = scene_of(jelly(1e5, 0.05));
    scene.objects = {box("a", {0.2, 0.2, 0.2}, {0.0, 0.0, 0.0}),
                     box("b", {0.2, 0.2, 0.2}, {0.0, -0.206, 0.0})};
    scene.objects[0].pins = {above(0.09)};
    MeasuredRun run(scene);
    EXPECT_EQ(run.simulator().attach({.name = "late", .object = "b", .to = "a"}), 0u);
    run.advance(4.0);
    EXPECT_EQ(run.simulator().attachments()[0].name, "late");
    EXPECT_GT(run.center(1).y, -0.3);
    EXPECT_NEAR(run.force(0).y, run.mass(1) * kGravity, 0.02 * run.mass(1) * kGravity);
    EXPECT_THROW(run.simulator().attach({.object = "b", .to = "c"}), InvalidInput);
    EXPECT_THROW(run.simulator().attach({.object = "b", .where = above(5.0)}), InvalidInput);
    EXPECT_EQ(run.simulator().attachments().size(), 1u);
    run.simulator().reset();
    EXPECT_TRUE(run.simulator().attachments().empty());
    run.advance(2.0);
    EXPECT_LT(run.center(1).y, -5.0);
}

// Glued surfaces do not press each other, though they are nearer than their reach.
TEST(Attachments, WhatIsGluedDoesNotPress) {
    Scene scene = hanging_row();
    scene.simulation.gravity = glm::dvec3(0.0);
    scene.objects[1].position.y = 0.797;
    scene.objects[2].position.y = 0.594;
    MeasuredRun run(scene);
    run.advance(1.0);
    EXPECT_LT(glm::length(run.force(1)), 5e-3);
    EXPECT_TRUE(run.simulator().contact_forces().empty());

    scene.objects.resize(1);
    ColliderDescription floor;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, 0.899};
    floor.name = "floor";
    scene.colliders = {floor};
    scene.attachments = {{.object = "top", .to = "floor"}};
    MeasuredRun beside_plane(scene);
    beside_plane.advance(1.0);
    EXPECT_LT(glm::length(beside_plane.force(0)), 0.02);
}

// Pressed together by a weight, and with ties that yield: still nothing crosses.
TEST(Attachments, NothingCrossesWhereTheyYield) {
    Scene scene = scene_of(jelly(3e4, 0.02));
    scene.objects = {box("a", {0.3, 0.1, 0.3}, {0.0, 0.056, 0.0}),
                     box("b", {0.3, 0.1, 0.3}, {0.0, 0.162, 0.0}),
                     box("c", {0.2, 0.3, 0.2}, {0.0, 0.7, 0.0})};
    scene.objects[2].velocity = {0.0, -3.0, 0.0};
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    scene.colliders = {floor};
    scene.attachments = {{.object = "b", .to = "a", .compliance = 1e-3}};
    MeasuredRun run(scene);
    for (int k = 0; k < 40; ++k) {
        run.advance(0.05);
        ASSERT_EQ(run.overlaps(), 0u) << k;
    }
}

// A stiff double pendulum rotates about its joints until the blocks' corners meet, and gains nothing there.
TEST(Attachments, PartsOfAJointPressEachOther) {
    Scene scene = scene_of(jelly(1e7));
    scene.objects = {box("a", {0.28, 0.2, 0.24}, {0.0, 0.0, 0.0}),
                     box("b", {0.28, 0.2, 0.24}, {0.34, 0.0, 0.0})};
    for (ObjectDescription& object : scene.objects) {
        object.shape = BoxShape{{0.28, 0.2, 0.24}, {3, 2, 2}};
        object.mesher = {};
    }
    scene.attachments = {{.object = "a", .to = "b", .where = AttachedPoint{{0.17, 0.0, 0.0}}},
                         {.object = "a", .where = AttachedPoint{{-0.17, 0.0, 0.0}}}};
    MeasuredRun run(scene);
    const double start = run.energy();
    const double scale = kGravity * (run.mass(0) + run.mass(1)) * 0.34;
    bool press = false;
    for (int k = 0; k < 300; ++k) {
        run.simulator().advance_frame();
        ASSERT_LT(run.energy(), start + 0.01 * scale) << k;
        ASSERT_EQ(run.overlaps(), 0u) << k;
        press = press || !run.simulator().contact_forces().empty();
    }
    EXPECT_TRUE(press);
}

// What breaks has not pulled harder than it can: these fly on as they did.
TEST(Attachments, BreakBeforeTheyPullTooHard) {
    Scene scene = rigid_scene(0.5, glm::dvec3(0.0));
    scene.objects = {rigid_box("left", {0.2, 0.2, 0.2}, {-0.2, 0.0, 0.0}),
                     rigid_box("right", {0.2, 0.2, 0.2}, {0.2, 0.0, 0.0})};
    scene.objects[0].velocity = {-2.0, 0.0, 0.0};
    scene.objects[1].velocity = {2.0, 0.0, 0.0};
    scene.attachments = {
        {.object = "left", .to = "right", .where = AttachedPoint{{0.0, 0.0, 0.0}}, .break_force = 50.0}};
    MeasuredRun run(scene);
    const double energy = run.energy();
    run.advance(0.2);
    EXPECT_TRUE(run.is_broken(0));
    EXPECT_NEAR(run.energy(), energy, 1e-4 * energy);
}

// In the middle of an impact, of which nothing is left then.
TEST(Attachments, WhatAHandTouchesMayFallAsleep) {
    Scene scene = scene_of(jelly(1e6), 0.0);
    scene.objects = {box("a", {0.3, 0.3, 0.3}, {0.0, 0.152, 0.0})};
    scene.objects[0].mesher = {};
    scene.objects[0].shape = BoxShape{glm::dvec3(0.3), glm::ivec3(2)};
    scene.materials[0].density = 1000.0;
    scene.collision.self_collision = {};
    ColliderDescription floor, hand;
    floor.shape = PlaneCollider{};
    hand.shape = BoxShape{{0.1, 0.1, 0.1}};
    hand.position = {-0.202, 0.152, 0.0};
    hand.keyframes = {{0.0}, {0.7, {-0.06, 0.033, 0.0}}, {1.4}};
    scene.colliders = {floor, hand};
    scene.attachments = {{.object = "a", .where = AttachedPoint{{-0.15, 0.152, 0.0}}}};
    MeasuredRun run(scene);
    run.advance(2.5);
    EXPECT_EQ(run.overlaps(), 0u);
}

// Attached bodies come to rest together, sleep, and are woken together.
TEST(Attachments, SleepAndWakeTogether) {
    Scene scene = scene_of(jelly(1e5, 0.1));
    scene.objects = {box("a", {0.2, 0.2, 0.2}, {0.0, 0.106, 0.0}),
                     box("b", {0.2, 0.2, 0.2}, {0.206, 0.106, 0.0})};
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    scene.colliders = {floor};
    scene.attachments = {{.object = "b", .to = "a"}};
    MeasuredRun run(scene);
    run.advance(6.0);
    const glm::dvec3 a = run.center(0), b = run.center(1);
    run.advance(1.0);
    EXPECT_EQ(run.center(0), a) << "asleep";
    const std::vector<glm::vec3> forces(run.model().objects[0].nodes.count, glm::vec3(0.0f, 3.0f, 0.0f));
    run.simulator().set_forces(0, forces);
    run.advance(1.0);
    EXPECT_GT(run.center(0).y, a.y + 0.1);
    EXPECT_GT(run.center(1).y, b.y + 0.05);
}

TEST(Attachments, GoOnFromACheckpoint) {
    const auto file = std::filesystem::path(::testing::TempDir()) / "attached.gelatin";
    Scene scene = hanging_row();
    scene.attachments[2].break_force = 0.9 * 8.0 * kGravity;
    MeasuredRun run(scene), other(scene);
    run.advance(0.5);
    ASSERT_TRUE(run.is_broken(2));
    run.simulator().save_checkpoint(file);
    run.advance(0.5);
    other.simulator().load_checkpoint(file);
    EXPECT_TRUE(other.is_broken(2));

    other.advance(0.5);
    for (const std::size_t object : {0u, 1u, 2u}) EXPECT_EQ(other.center(object), run.center(object));
    // What was made later is no longer there.
    other.simulator().attach({.object = "bottom", .where = AttachedPoint{other.center(2)}});
    other.advance(0.1);
    other.simulator().load_checkpoint(file);
    EXPECT_EQ(other.simulator().attachments().size(), 3u);
    EXPECT_EQ(other.simulator().scene().attachments.size(), 3u);
    other.advance(0.5);
    EXPECT_EQ(other.center(2), run.center(2));
    std::filesystem::remove(file);
}

// The host makes the steps.
class AttachmentsOnGlTest : public GlTest {};
TEST_F(AttachmentsOnGlTest, AreThoseOfTheCpu) {
    for (const CollisionResponse response : {CollisionResponse::contact, CollisionResponse::restore}) {
        Scene scene = hanging_row();
        scene.collision.response = response;
        scene.collision.self_collision = {};
        SimulatorOptions on_gl;
        on_gl.backend = Backend::gl;
        on_gl.use_current_context = true;
        MeasuredRun cpu(scene), gl(scene, on_gl);
        cpu.advance(0.5);
        gl.advance(0.5);
        for (const std::size_t object : {0u, 1u, 2u}) {
            EXPECT_LT(glm::distance(gl.center(object), cpu.center(object)), 1e-5);
            EXPECT_LT(glm::distance(gl.force(object), cpu.force(object)),
                      0.01 * glm::length(cpu.force(object)));
        }
    }
}

}  // namespace
}  // namespace gelatin::attachment_test
