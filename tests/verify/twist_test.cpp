// scenes/twist.toml: a bar is twisted two turns by a handle and let go, on both backends.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin::twist_test {
namespace {

class TwistHeavy : public ::testing::Test {};
class TwistLong : public test::GlTest {};

// The mean angle about x by which the nodes of the free end have turned, followed from frame to frame.
class Twist {
public:
    explicit Twist(const Simulator& simulator) {
        const Model& model = model_of(simulator);
        for (const HandleNode& held : model.handle_nodes) {
            if (!model.handles[held.handle].is_pin) held_.push_back(held);
        }
    }

    double update(const HostFrame& frame) {
        double along = 0.0, across = 0.0;
        for (const HandleNode& held : held_) {
            const auto y = static_cast<double>(held.arm.y), z = static_cast<double>(held.arm.z);
            const auto now_y = static_cast<double>(frame.positions[3 * held.node + 1] - center(frame, 1)),
                       now_z = static_cast<double>(frame.positions[3 * held.node + 2] - center(frame, 2));
            along += y * now_y + z * now_z;
            across += y * now_z - z * now_y;
        }
        const double angle = std::atan2(across, along);
        angle_ += std::remainder(angle - angle_, 2.0 * std::numbers::pi);
        return angle_;
    }

private:
    float center(const HostFrame& frame, std::size_t axis) const {
        float sum = 0.0f;
        for (const HandleNode& held : held_) sum += frame.positions[3 * held.node + axis];
        return sum / static_cast<float>(held_.size());
    }

    std::vector<HandleNode> held_;
    double angle_ = 0.0;  // [rad]
};

void play(Backend backend) {
    SimulatorOptions options;
    options.backend = backend;
    options.use_current_context = backend == Backend::gl;
    Simulator simulator(load_scene(test::source_path("scenes/twist.toml")), options);
    Twist twist(simulator);
    constexpr double kTurns = 4.0 * std::numbers::pi;
    double held = 0.0, least = 1e9, elastic_when_held = 0.0;
    FrameStatistics last;
    for (int f = 1; f <= 480; ++f) {
        simulator.advance_frame();
        const double angle = twist.update(simulator.read_frame());
        simulator.begin_statistics();
        last = simulator.take_statistics();  // throws where it is not finite
        if (f == 235) {
            held = angle;
            elastic_when_held = last.elastic_energy;
        }
        if (f > 240) least = std::min(least, angle);
        EXPECT_GT(last.volume_ratio[0], 0.7) << "frame " << f;
        if (f > 241) {
            EXPECT_LT(last.kinetic_energy + last.elastic_energy, 1.02 * elastic_when_held) << "frame " << f;
        }
    }
    EXPECT_NEAR(held, kTurns, 1e-3) << "two turns";
    EXPECT_LT(least, 0.05 * kTurns) << "it spins all the way back";
    EXPECT_LT(last.elastic_energy, 0.2 * elastic_when_held);
}

TEST_F(TwistHeavy, ComesBackOnTheCpu) {
    play(Backend::cpu);
}

TEST_F(TwistLong, ComesBackOnGl) {
    play(Backend::gl);
}

}  // namespace
}  // namespace gelatin::twist_test
