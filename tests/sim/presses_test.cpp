// Colliders and handles that bodies block: what becomes of the rest of their motion (WhenBlocked).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/file.h"
#include "gelatin/error.h"
#include "sim/simulator_internals.h"
#include "support/overlaps.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

constexpr double kDepth = 0.5;     // that the plate is to come down [m]
constexpr double kEnd = 1.0;       // when it is to be there [s]
constexpr double kMeets = 0.4;     // when it meets the block [s]
constexpr double kReleased = 1.0;  // when the block falls [s]

// A plate comes down on a block that a handle holds in the air until it lets go of it.
Scene press_scene(WhenBlocked when_blocked, std::optional<int> substeps = 1) {
    Scene scene;
    scene.simulation.substeps = substeps;
    scene.collision.response = CollisionResponse::contact;
    scene.collision.restitution = 0.0;
    scene.collision.friction = 0.0;
    scene.materials.resize(1);
    scene.materials[0].name = "rubber";
    scene.materials[0].youngs_modulus = 1e6;
    ObjectDescription block;
    block.name = "block";
    block.material = "rubber";
    block.shape = BoxShape{glm::dvec3(0.2), glm::ivec3(2)};
    HandleDescription hold;
    hold.region = SphereRegion{{0.0, 0.0, 0.0}, 1.0};
    hold.release = kReleased;
    block.handles = {hold};
    scene.objects = {block};
    ColliderDescription plate, floor;
    plate.name = "plate";
    plate.shape = Shape{BoxShape{{0.5, 0.1, 0.5}}};
    plate.position = {0.0, 0.15 + kMeets / kEnd * kDepth, 0.0};
    plate.keyframes = {{0.0}, {kEnd, {0, -kDepth, 0}}};
    plate.when_blocked = when_blocked;
    floor.shape = PlaneCollider{{0.0, 1.0, 0.0}, -2.0};
    scene.colliders = {plate, floor};
    return scene;
}

// How far the object of this number has come down [m]; of a body, its first node.
double descent(const Simulator& simulator, std::size_t object = 1) {
    const std::uint32_t n = model_of(simulator).objects[object].nodes.first;
    return static_cast<double>(model_of(simulator).positions[n].y -
                               simulator.read_frame().positions[3 * n + 1]);
}

std::size_t overlaps(const Simulator& simulator) {
    const HostFrame frame = simulator.read_frame();
    std::vector<cpu::Vec4<float>> positions;
    for (std::size_t n = 0; n < frame.positions.size() / 3; ++n)
        positions.emplace_back(frame.positions[3 * n], frame.positions[3 * n + 1], frame.positions[3 * n + 2],
                               0);
    return test::count_overlaps(model_of(simulator), positions);
}

// The plate's descents after each frame. Nothing ever passes through anything, and no energy is unexplained.
std::vector<double> run(Simulator& simulator, int frames) {
    std::vector<double> descents;
    for (int f = 0; f < frames; ++f) {
        simulator.advance_frame();
        EXPECT_EQ(overlaps(simulator), 0u) << f;
        simulator.begin_statistics();
        EXPECT_NO_THROW(simulator.take_statistics()) << f;
        descents.push_back(descent(simulator));
    }
    return descents;
}

double after(const std::vector<double>& descents, double time) {
    return descents[static_cast<std::size_t>(std::lround(time * 60.0)) - 1];
}

using PressTest = test::SimulatorFixture;

// The place where a block is in its way, and when it has gone that where the keyframes are by then.
TEST_F(PressTest, CatchesUpWhereItsTimeGoesOn) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(press_scene(WhenBlocked::goes_on), on(backend));
        const std::vector<double> descents = run(simulator, 180);
        EXPECT_NEAR(after(descents, 0.3), 0.3 * kDepth / kEnd, 1e-5);
        EXPECT_NEAR(after(descents, 0.95), kMeets * kDepth / kEnd, 0.01);
        // Not at once: its keyframes are over, so it goes by thicknesses.
        EXPECT_LT(after(descents, kReleased + 0.2), 0.7 * kDepth);
        EXPECT_NEAR(after(descents, kReleased + 1.4), kDepth, 1e-5);
    }
}

// It goes on from where it stopped, as fast as it would have, and comes to the end later by how long it
// stood.
TEST_F(PressTest, GoesOnFromWhereItStopped) {
    const double delay = kReleased - kMeets, speed = kDepth / kEnd;
    for (const std::optional<int> substeps : {std::optional<int>(1), std::optional<int>()}) {
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            Simulator simulator(press_scene(WhenBlocked::stops, substeps), on(backend));
            const std::vector<double> descents = run(simulator, 108);
            EXPECT_NEAR(after(descents, 0.3), 0.3 * speed, 1e-5) << "nothing has held it up";
            EXPECT_NEAR(after(descents, 0.95), kMeets * speed, 0.01);
            for (const double time : {1.1, 1.2, 1.3, 1.4, 1.5})
                EXPECT_NEAR(after(descents, time), (time - delay) * speed, 0.03) << time;
            EXPECT_LT(after(descents, kEnd + delay - 0.1), kDepth - 0.02);
            EXPECT_NEAR(after(descents, kEnd + delay + 0.1), kDepth, 1e-5);
            // Without a jump: no faster than its keyframes, but for as much as its target was ahead.
            double fastest = 0.0, before = 0.0;
            for (const double now : descents) fastest = std::max(fastest, now - std::exchange(before, now));
            EXPECT_LT(fastest, 2.5 * speed / 60.0 + 0.01);
        }
    }
}

TEST_F(PressTest, StandsStillForAsLongAsItMust) {
    Scene scene = press_scene(WhenBlocked::stops);
    scene.objects[0].handles[0].release.reset();
    Simulator simulator(scene, on(Backend::cpu));
    const std::vector<double> descents = run(simulator, 150);
    EXPECT_NEAR(descents.back(), after(descents, 0.7), 1e-4);
    EXPECT_NEAR(descents.back(), kMeets * kDepth / kEnd, 0.01);
}

TEST_F(PressTest, GoesOnFromACheckpoint) {
    const TemporaryFolder folder;
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        const Scene scene = press_scene(WhenBlocked::stops);
        for (const int saved : {42, 70}) {  // while it stands, and on its later motion
            Simulator whole(scene, on(backend)), again(scene, on(backend));
            run(whole, saved);
            whole.save_checkpoint(folder.path() / "a.ckpt");
            again.load_checkpoint(folder.path() / "a.ckpt");
            const std::vector<double> expected = run(whole, 110 - saved), descents = run(again, 110 - saved);
            for (std::size_t f = 0; f < descents.size(); ++f)
                EXPECT_NEAR(descents[f], expected[f], 1e-5) << saved << " + " << f;
            EXPECT_GT(again.time(), kEnd + 0.5);
        }
    }
}

TEST_F(PressTest, ResetPutsItsTimeBack) {
    Simulator simulator(press_scene(WhenBlocked::stops), on(Backend::cpu));
    const std::vector<double> first = run(simulator, 80);
    simulator.reset();
    EXPECT_EQ(run(simulator, 80), first);
}

// What an edited scene takes over stays late.
TEST_F(PressTest, StaysLateInAnEditedScene) {
    Scene scene = press_scene(WhenBlocked::stops);
    Simulator before(scene, on(Backend::cpu));
    run(before, 75);
    scene.materials[0].youngs_modulus *= 2.0;
    Simulator next(scene, on(Backend::cpu));
    next.go_on_from(before);
    next.advance_frame();
    before.advance_frame();
    EXPECT_NEAR(descent(next), descent(before), 0.02);
    EXPECT_LT(descent(next), kDepth - 0.1);
}

// Two bars at the block's sides come down by their handles: one on a shelf, and one beside it.
Scene bars_scene(double release) {
    Scene scene = press_scene(WhenBlocked::stops);
    scene.objects[0].handles[0].release = release;
    scene.colliders.erase(scene.colliders.begin());
    for (const double x : {0.0, 2.0}) {
        ObjectDescription bar = scene.objects[0];
        bar.name = x == 0.0 ? "blocked" : "free";
        bar.position = {x, 0.2 + kMeets / kEnd * kDepth, 0.0};
        HandleDescription& handle = bar.handles[0];
        handle.region = SphereRegion{bar.position, 1.0};
        handle.keyframes = {{0.0}, {kEnd, {0, -kDepth, 0}}};
        handle.when_blocked = WhenBlocked::stops;
        handle.release = 1.3;
        scene.objects.push_back(bar);
    }
    return scene;
}

// By its own time a handle moves and lets go. One that is blocked does not stop another.
TEST_F(PressTest, HandlesOfBodiesStop) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator(bars_scene(kReleased), on(backend));
        const auto is_released = [&](std::size_t handle) {
            return simulator.held_nodes()[handle].is_released;
        };
        for (int f = 0; f < 57; ++f) simulator.advance_frame();
        EXPECT_NEAR(descent(simulator, 1), kMeets * kDepth / kEnd, 0.01);
        EXPECT_NEAR(descent(simulator, 2), 0.95 * kDepth / kEnd, 1e-5);
        for (int f = 57; f < 90; ++f) simulator.advance_frame();  // 1.5 s
        EXPECT_EQ(overlaps(simulator), 0u);
        EXPECT_TRUE(is_released(2));
        EXPECT_GT(descent(simulator, 2), kDepth + 0.1) << "it falls";
        EXPECT_FALSE(is_released(1));
        EXPECT_NEAR(descent(simulator, 1), 0.9 * kDepth / kEnd, 0.03);
        EXPECT_NEAR(simulator.held_nodes()[1].center.y, 0.2 + (kMeets - 0.9) * kDepth / kEnd, 0.03);
        for (int f = 90; f < 108; ++f) simulator.advance_frame();  // 1.8 s
        EXPECT_FALSE(is_released(1));
        EXPECT_NEAR(descent(simulator, 1), kDepth, 1e-5);
        for (int f = 108; f < 126; ++f) simulator.advance_frame();  // 2.1 s
        EXPECT_TRUE(is_released(1));
        EXPECT_GT(descent(simulator, 1), kDepth + 0.1);
    }
}

// What it does later is as much of its work as what it would have done by then.
TEST_F(PressTest, MayThrowABodyLater) {
    Scene scene = bars_scene(kReleased);
    scene.materials[0].youngs_modulus = 1e4;
    scene.collision.self_collision = false;  // what is torn so far apart would keep itself from it
    scene.objects.pop_back();
    HandleDescription& handle = scene.objects[1].handles[0];
    handle.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.49};  // its upper side
    handle.keyframes.push_back({kEnd + 0.1, {20.0, -kDepth, 0.0}});
    handle.release.reset();
    Simulator simulator(scene, on(Backend::cpu));
    double fastest = 0.0;
    for (int f = 0; f < 120; ++f) {
        simulator.advance_frame();
        simulator.begin_statistics();
        FrameStatistics statistics;
        ASSERT_NO_THROW(statistics = simulator.take_statistics()) << f;
        if (simulator.time() < kEnd + 0.15) {
            EXPECT_LT(statistics.kinetic_energy, 500.0) << f;
        }
        fastest = std::max(fastest, statistics.kinetic_energy);
    }
    EXPECT_GT(fastest, 1e4);
}

}  // namespace
}  // namespace gelatin
