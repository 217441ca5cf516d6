// A ball that flies farther in a step than a plate is thick: scenes/bullet.toml with an explicit solver.
#include <gtest/gtest.h>

#include <algorithm>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin::bullet_test {
namespace {

constexpr float kThickness = 0.005f;  // of the plate [m]

// The share of the ball's surface nodes that are behind all of the plate's within 5 cm beside them, by more
// than its thickness: surfaces may stay a little inside each other. Inner nodes have no faces that could
// collide: what holds them is the surface round them.
double share_behind_the_plate(const Simulator& simulator) {
    const std::vector<float> positions = simulator.read_frame().positions;
    const auto place = [&](std::uint32_t n) {
        return glm::vec3(positions[3 * n], positions[3 * n + 1], positions[3 * n + 2]);
    };
    const Range &plate = model_of(simulator).objects[0].nodes, &ball = model_of(simulator).objects[1].nodes;
    const std::vector<std::uint32_t>& face_starts = model_of(simulator).node_faces.starts;
    int behind = 0, count = 0;
    for (std::uint32_t n = ball.first; n < ball.end(); ++n) {
        if (face_starts[n] == face_starts[n + 1]) continue;
        const glm::vec3 p = place(n);
        float lowest = 0.0f;
        for (std::uint32_t k = plate.first; k < plate.end(); ++k) {
            const glm::vec3 q = place(k);
            if (std::abs(q.x - p.x) < 0.05f && std::abs(q.y - p.y) < 0.05f) lowest = std::min(lowest, q.z);
        }
        behind += p.z < lowest - kThickness ? 1 : 0;
        ++count;
    }
    return static_cast<double>(behind) / count;
}

class BulletHeavy : public test::GlTest {
protected:
    // When it would have flown half a metre, of which 17 cm lead to the plate.
    static double share_that_passes(Backend backend, CollisionDetection detection, double speed) {
        Scene scene = load_scene(test::source_path("scenes/bullet.toml"),
                                 {"simulation.solver=semi_implicit_euler", "simulation.frame_rate=6000",
                                  "collision.response=restore", "collision.restitution=0.3"});
        scene.collision.detection = detection;
        scene.objects[1].velocity = {0.0, 0.0, -speed};
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(scene, options);
        EXPECT_GT(300.0 * simulator.step_size(), 3 * kThickness) << "the step is too short to test anything";
        const int frames = std::max(8, static_cast<int>(0.5 / speed * scene.simulation.frame_rate));
        for (int frame = 0; frame < frames; ++frame) simulator.advance_frame();
        return share_behind_the_plate(simulator);
    }
};

TEST_F(BulletHeavy, IsStoppedByThePlateAtAnySpeed) {
    for (const double speed : {50.0, 100.0, 300.0, 500.0}) {
        for (const Backend backend : {Backend::cpu, Backend::gl})
            EXPECT_EQ(share_that_passes(backend, CollisionDetection::continuous, speed), 0.0) << speed;
    }
}

TEST_F(BulletHeavy, DiscreteDetectionLetsItThrough) {
    for (const Backend backend : {Backend::cpu, Backend::gl})
        EXPECT_GT(share_that_passes(backend, CollisionDetection::discrete, 250.0), 0.5);
}

}  // namespace
}  // namespace gelatin::bullet_test
