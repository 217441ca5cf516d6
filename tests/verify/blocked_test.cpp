// What moves by keyframes waits for what is in its way, and does not hit it with all that it is behind then.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "verify/support/attached_boxes.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::blocked_test {
namespace {

using namespace test;

ColliderDescription floor_at_zero() {
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    return floor;
}

// Goes 1 m down in a second, from above a body of 0.3 m.
ColliderDescription hand() {
    ColliderDescription hand;
    hand.name = "hand";
    hand.shape = BoxShape{{0.2, 0.1, 0.2}};
    hand.position = {0.0, 0.61, 0.0};
    hand.keyframes = {{0.0}, {1.0, {0.0, -1.0, 0.0}}};
    return hand;
}

double kinetic_energy(MeasuredRun& run) {
    return run.statistics().kinetic_energy;
}

// @return the greatest kinetic energy on the way [J]
double advance(MeasuredRun& run, double seconds) {
    double most = 0.0;
    for (double end = run.simulator().time() + seconds; run.simulator().time() < end - 1e-6;) {
        run.advance(1.0 / 60.0);
        most = std::max(most, kinetic_energy(run));
    }
    return most;
}

TEST(Blocked, AHandWaitsForTheRigidBodyThatIsGluedToIt) {
    Scene scene = rigid_scene(0.5, {0.0, -kGravity, 0.0});
    scene.objects = {rigid_box("box", {0.3, 0.3, 0.3}, {0.0, 0.4, 0.0})};
    scene.colliders = {floor_at_zero(), hand()};
    scene.attachments = {{.object = "box", .to = "hand"}};
    MeasuredRun run(scene);
    EXPECT_LT(advance(run, 3.0), 60.0);
    EXPECT_LT(kinetic_energy(run), 1e-3);
    EXPECT_NEAR(run.center(0).y, 0.15, 0.02);
    EXPECT_EQ(run.overlaps(), 0u);
}

TEST(Blocked, AHandCrushesASoftBlockAsItGivesWay) {
    Scene scene = scene_of(jelly(1e5));
    scene.objects = {box("block", {0.3, 0.3, 0.3}, {0.0, 0.4, 0.0}, 60)};
    scene.colliders = {floor_at_zero(), hand()};
    MeasuredRun run(scene);
    EXPECT_LT(advance(run, 2.0), 400.0);
    EXPECT_LT(kinetic_energy(run), 5.0);
    EXPECT_GT(run.center(0).y, 0.0);
    EXPECT_EQ(run.overlaps(), 0u);
}

// At a turn a second its walls go at some 3 m/s.
TEST(Blocked, ADrumThatTurnsDoesNotThrowWhatIsInIt) {
    Scene scene = scene_of(jelly(1e5));
    scene.materials[0] = Material();
    scene.materials[0].name = "jelly";
    scene.collision.self_collision = {};
    scene.simulation.gravity = {};
    scene.objects = {box("ball", {}, {0.25, 0.0, 0.0})};
    scene.objects[0].mesher = {};
    scene.objects[0].shape = SphereShape{.radius = 0.12, .frequency = 4};
    ColliderDescription drum;
    drum.shape = BoxShape{{1.0, 1.0, 1.0}};
    drum.keyframes = {{0.0}, {4.0, glm::dvec3(0.0), {0.0, 0.0, 1440.0}}};
    scene.colliders = {drum};
    MeasuredRun run(scene);
    EXPECT_LT(advance(run, 1.0), 1000.0);
    EXPECT_LT(glm::length(run.center(0)), 0.9);
}

// Two plates close on it, wait, and would go up by 0.8 m.
TEST(Blocked, PlatesThatWaitCarryNothing) {
    Scene scene = rigid_scene(0.8);
    scene.objects = {rigid_box("box", {0.4, 0.4, 0.4}, {0.0, 0.2025, 0.0})};
    scene.colliders = {floor_at_zero()};
    for (const double side : {-1.0, 1.0}) {
        ColliderDescription plate;
        plate.shape = BoxShape{{0.1, 0.6, 0.6}};
        plate.position = {0.28 * side, 0.35, 0.0};
        plate.keyframes = {{0.0}, {1.0, {-0.05 * side, 0.0, 0.0}}, {2.0, {-0.05 * side, 0.8, 0.0}}};
        scene.colliders.push_back(plate);
    }
    MeasuredRun run(scene);
    run.advance(2.5);
    const std::uint32_t plate = run.model().objects[1].nodes.first;
    const double start = static_cast<double>(run.model().positions[plate].y),
                 end = static_cast<double>(run.simulator().positions()[plate].y);
    EXPECT_LT(end - start, 0.05);
    EXPECT_LT(run.center(0).y - 0.2025, end - start);
    EXPECT_EQ(run.overlaps(), 0u);
}

}  // namespace
}  // namespace gelatin::blocked_test
