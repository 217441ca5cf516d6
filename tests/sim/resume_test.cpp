// Simulations go on from checkpoints and from other simulations.
#include <gtest/gtest.h>

#include <cmath>

#include "core/file.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/simulator_fixture.h"

namespace gelatin {
namespace {

using test::driven_balls, test::falling_balls;

using ResumeTest = test::SimulatorFixture;

TEST_F(ResumeTest, GoesOnFromACheckpointBitForBit) {
    const TemporaryFolder folder;
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator whole(falling_balls(), on(backend)), again(falling_balls(), on(backend));
        for (int f = 0; f < 20; ++f) whole.advance_frame();
        whole.save_checkpoint(folder.path() / "a.ckpt");
        again.load_checkpoint(folder.path() / "a.ckpt");
        EXPECT_EQ(again.frame(), 20);
        for (int f = 0; f < 20; ++f) {
            whole.advance_frame();
            again.advance_frame();
        }
        EXPECT_EQ(again.frame(), 40);
        EXPECT_DOUBLE_EQ(again.time(), whole.time());
        EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
        EXPECT_EQ(again.read_frame().velocities, whole.read_frame().velocities);
    }
}

// In the middle of a handle's motion, and of a load's time, and after the release.
TEST_F(ResumeTest, HandlesAndLoadsGoOnFromACheckpointBitForBit) {
    const TemporaryFolder folder;
    for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::implicit}) {
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            const Scene scene = driven_balls(solver);
            Simulator whole(scene, on(backend));
            std::vector<Simulator> others;
            for (int f = 0; f < 40; ++f) {
                if (f == 7 || f == 21) {
                    whole.save_checkpoint(folder.path() / "a.ckpt");
                    others.emplace_back(scene, on(backend)).load_checkpoint(folder.path() / "a.ckpt");
                }
                whole.advance_frame();
                for (Simulator& other : others) other.advance_frame();
            }
            ASSERT_EQ(others.size(), 2u);
            for (const Simulator& other : others) {
                EXPECT_EQ(other.frame(), 40);
                EXPECT_EQ(other.time(), whole.time());
                EXPECT_EQ(other.read_frame().positions, whole.read_frame().positions);
                EXPECT_EQ(other.read_frame().velocities, whole.read_frame().velocities);
            }
        }
    }
}

// What contacts hold, owe and have met with goes on, and so does sleep: blocks that bounce, lie on each
// other, slide, and are carried.
TEST_F(ResumeTest, ContactsGoOnFromACheckpointBitForBit) {
    Scene scene;
    scene.collision.restitution = 0.5;
    Material& material = scene.materials.emplace_back();
    material.name = "jelly";
    material.damping = 0.01;
    for (int i = 0; i < 4; ++i) {
        ObjectDescription& block = scene.objects.emplace_back();
        block.name = "block" + std::to_string(i);
        block.material = "jelly";
        block.shape = BoxShape{.size = glm::dvec3(0.2), .segments = glm::ivec3(2)};
        block.position = {i < 3 ? 0.01 * i : 0.6, i < 3 ? 0.12 + 0.25 * i : 0.11, 0.0};
        if (i == 3) block.velocity = {1.0, 0.0, 0.3};
    }
    HandleDescription& hold = scene.objects[2].handles.emplace_back();
    hold.region = HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.7};
    hold.keyframes = {{0.0}, {0.3, {0.0, -0.12, 0.0}}};
    hold.release = 0.5;
    scene.colliders.emplace_back();
    const TemporaryFolder folder;
    constexpr int kFrames = 300;
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator whole(scene, on(backend));
        std::vector<Simulator> others;
        for (int f = 0; f < kFrames; ++f) {
            for (const int start : {5, 12, 19, 26, 40, 280}) {
                if (f != start) continue;
                whole.save_checkpoint(folder.path() / "a.ckpt");
                others.emplace_back(scene, on(backend)).load_checkpoint(folder.path() / "a.ckpt");
            }
            whole.advance_frame();
            for (Simulator& other : others) other.advance_frame();
        }
        for (const Simulator& other : others) {
            EXPECT_EQ(other.read_frame().positions, whole.read_frame().positions);
            EXPECT_EQ(other.read_frame().velocities, whole.read_frame().velocities);
            EXPECT_GT(whole.contact_forces().size(), 0u);
            EXPECT_EQ(other.contact_forces().size(), whole.contact_forces().size()) << "of what sleeps, too";
        }
    }
}

// Without it, or with that of a scene with other colliders, the state is what counts.
TEST_F(ResumeTest, CheckpointsGoOnInScenesWithOtherColliders) {
    const TemporaryFolder folder;
    Scene scene = falling_balls();
    scene.simulation.solver = SolverKind::implicit;
    scene.collision.response = CollisionResponse::contact;
    Simulator whole(scene, on(Backend::cpu));
    for (int f = 0; f < 20; ++f) whole.advance_frame();
    whole.save_checkpoint(folder.path() / "a.ckpt");
    ColliderDescription& wall = scene.colliders.emplace_back();
    wall.name = "wall";
    wall.shape = PlaneCollider{{1.0, 0.0, 0.0}, -50.0};
    scene.materials[0].youngs_modulus *= 2.0;
    Simulator other(scene, on(Backend::cpu));
    other.load_checkpoint(folder.path() / "a.ckpt");
    EXPECT_EQ(other.read_frame().positions, whole.read_frame().positions);
    other.advance_frame();
    whole.advance_frame();
    EXPECT_LT(test::largest_difference(other.read_frame(), whole.read_frame()), 0.01);
}

// A checkpoint from within a frame, which knows the frames that are done, goes on with the same times.
TEST_F(ResumeTest, ResetGoesBackToTheVeryStart) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        for (const SolverKind solver : {SolverKind::semi_implicit_euler, SolverKind::implicit}) {
            Simulator simulator(driven_balls(solver), on(backend));
            const auto run = [&] {
                for (int f = 0; f < 12; ++f) simulator.advance_frame();
                return simulator.read_frame();
            };
            const HostFrame first = run();
            simulator.begin_statistics();
            simulator.reset();
            EXPECT_EQ(simulator.frame(), 0);
            EXPECT_EQ(simulator.pending_statistics(), 0u);
            const HostFrame second = run();
            EXPECT_EQ(second.positions, first.positions) << simulator.backend();
            EXPECT_EQ(second.velocities, first.velocities) << simulator.backend();
        }
    }
}

// What is edited goes on; what is new begins; masses are the edited scene's.
TEST_F(ResumeTest, GoesOnFromAnotherSimulation) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Scene scene = falling_balls();
        Simulator before(scene, on(backend));
        for (int f = 0; f < 10; ++f) before.advance_frame();
        const HostFrame there = before.read_frame();

        scene.materials[0].density *= 2.0;
        scene.simulation.solver = SolverKind::implicit;
        ObjectDescription third = scene.objects[0];
        third.name = "third";
        third.position = {0.0, 2.0, 0.0};
        scene.objects.insert(scene.objects.begin(), third);
        Simulator after(scene, on(backend));
        const HostFrame start = after.read_frame();
        after.go_on_from(before);
        EXPECT_EQ(after.time(), before.time());
        EXPECT_EQ(after.frame(), 10);
        const HostFrame here = after.read_frame();
        const std::size_t added = 3 * std::size_t{model_of(after).objects[0].nodes.count};
        EXPECT_EQ(
            std::vector(here.positions.begin() + static_cast<std::ptrdiff_t>(added), here.positions.end()),
            there.positions);
        EXPECT_EQ(
            std::vector(here.velocities.begin() + static_cast<std::ptrdiff_t>(added), here.velocities.end()),
            there.velocities);
        for (std::size_t k = 0; k < added; ++k) ASSERT_EQ(here.positions[k], start.positions[k]);

        // An impulse needs the new masses: the momentum of a fall is theirs.
        after.begin_statistics();
        before.begin_statistics();
        const double both = before.take_statistics().momentum[1];
        EXPECT_NEAR(after.take_statistics().momentum[1], 2.0 * both, 1e-3 * std::abs(both));
    }
}

TEST_F(ResumeTest, GoesOnFromWithinAFrame) {
    const TemporaryFolder folder;
    Scene scene = driven_balls(SolverKind::implicit);
    scene.simulation.substeps = 3;
    Simulator whole(scene, on(Backend::cpu)), again(scene, on(Backend::cpu));
    for (int s = 0; s < 7; ++s) whole.step();
    whole.save_checkpoint(folder.path() / "a.ckpt");
    again.load_checkpoint(folder.path() / "a.ckpt");
    for (int s = 0; s < 11; ++s) {
        whole.step();
        again.step();
    }
    EXPECT_EQ(again.frame(), 6);
    EXPECT_EQ(again.time(), whole.time());
    EXPECT_EQ(again.read_frame().positions, whole.read_frame().positions);
}

}  // namespace
}  // namespace gelatin
