// Two balls that fly at each other without gravity, as in the paper's second scene (4.2), from first touch to
// parting.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"

namespace gelatin::collision_test {
namespace {

constexpr double kSpeed = 3.0;  // of each ball [m/s]

Scene make_meeting(BroadPhase broad_phase = BroadPhase::hierarchy, ForceMethod forces = ForceMethod::fused) {
    Scene scene;
    scene.simulation.solver = SolverKind::semi_implicit_euler;
    scene.simulation.frame_rate = 500.0;
    scene.simulation.gravity = {0.0, 0.0, 0.0};
    scene.simulation.forces = forces;
    scene.collision.broad_phase = broad_phase;
    scene.collision.restitution = 0.5;
    Material jelly;
    jelly.name = "jelly";
    jelly.youngs_modulus = 1e6;
    jelly.damping = 1e-4;
    scene.materials = {jelly};
    for (const double side : {-1.0, 1.0}) {
        ObjectDescription ball;
        ball.name = side < 0.0 ? "left" : "right";
        ball.shape = SphereShape{side < 0.0 ? 0.5 : 0.35, 6};
        ball.material = "jelly";
        ball.position = {0.6 * side, 0.05 * side, 0.0};
        ball.velocity = {-kSpeed * side, 0.0, 0.0};
        scene.objects.push_back(ball);
    }
    return scene;
}

constexpr int kFrames = 120;  // they touch from frame 30 to 65 or so

class BallsTest : public test::GlTest {
protected:
    static Simulator simulate(const Scene& scene, Backend backend, int frames = 0) {
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(scene, options);
        for (int f = 0; f < frames; ++f) simulator.advance_frame();
        return simulator;
    }

    static FrameStatistics measure(Simulator& simulator) {
        simulator.begin_statistics();
        return simulator.take_statistics();
    }
};

// Mean x velocity of an object [m/s].
double speed_of(const Simulator& simulator, std::size_t object) {
    const HostFrame frame = simulator.read_frame();
    const Model& model = model_of(simulator);
    const Range& nodes = model.objects[object].nodes;
    double momentum = 0.0, mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        const auto m = static_cast<double>(model.masses[n]);
        momentum += m * static_cast<double>(frame.velocities[3 * n]);
        mass += m;
    }
    return momentum / mass;
}

TEST_F(BallsTest, PartAgainWithTheirMomentumAndNoMoreEnergy) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator simulator = simulate(make_meeting(), backend);
        const FrameStatistics start = measure(simulator);
        const double scale =
            (model_of(simulator).objects[0].mass + model_of(simulator).objects[1].mass) * kSpeed;
        double energy = start.kinetic_energy;
        std::size_t most_colliding = 0;
        FrameStatistics now = start;
        for (int f = 0; f < kFrames; ++f) {
            simulator.advance_frame();
            now = measure(simulator);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(now.momentum[k], start.momentum[k], 2e-5 * scale);
            // A symplectic step's energy swings by a little; nothing may be gained from frame to frame.
            EXPECT_LT(now.kinetic_energy + now.elastic_energy, 1.005 * energy) << "frame " << f;
            energy = now.kinetic_energy + now.elastic_energy;
            most_colliding = std::max(most_colliding, now.colliding_faces);
        }
        EXPECT_GT(most_colliding, 40u);
        EXPECT_EQ(now.colliding_faces, 0u) << "they have parted";
        const double parting = speed_of(simulator, 1) - speed_of(simulator, 0);
        EXPECT_GT(parting, 0.5 * 2 * kSpeed * 0.5) << "at most half of the bounce goes into vibration";
        EXPECT_LT(parting, 2 * kSpeed);
    }
}

// The paper's way and the fast one find the same collisions; forces summed in another order round
// differently.
TEST_F(BallsTest, DoTheSameByEveryPath) {
    const HostFrame reference = simulate(make_meeting(), Backend::cpu, kFrames).read_frame();
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        for (const BroadPhase broad_phase :
             {BroadPhase::none, BroadPhase::boxes, BroadPhase::hierarchy, BroadPhase::depth}) {
            if (broad_phase == BroadPhase::depth && backend == Backend::cpu) continue;  // needs OpenGL
            for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
                // How forces are summed does not depend on how collisions are found: one pairing is enough.
                if (forces == ForceMethod::divide_and_merge && broad_phase != BroadPhase::boxes) continue;
                const HostFrame other =
                    simulate(make_meeting(broad_phase, forces), backend, kFrames).read_frame();
                double largest = 0.0;
                for (std::size_t k = 0; k < reference.positions.size(); ++k) {
                    const double difference =
                        static_cast<double>(reference.positions[k] - other.positions[k]);
                    largest = std::max(largest, std::abs(difference));
                }
                EXPECT_LT(largest, 2e-3) << "of a displacement of half a metre, through an impact";
            }
        }
    }
}

TEST_F(BallsTest, RepeatBitForBit) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        const HostFrame one = simulate(make_meeting(), backend, kFrames).read_frame();
        const HostFrame two = simulate(make_meeting(), backend, kFrames).read_frame();
        EXPECT_EQ(one.positions, two.positions);
        EXPECT_EQ(one.velocities, two.velocities);
    }
}

TEST_F(BallsTest, AreTheSameForAnyNumberOfThreads) {
    const HostFrame parallel = simulate(make_meeting(), Backend::cpu, kFrames).read_frame();
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const HostFrame serial = simulate(make_meeting(), Backend::cpu, kFrames).read_frame();
    EXPECT_EQ(parallel.positions, serial.positions);
    EXPECT_EQ(parallel.velocities, serial.velocities);
}

}  // namespace
}  // namespace gelatin::collision_test
