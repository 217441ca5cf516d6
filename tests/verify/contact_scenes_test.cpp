// The scenes with contact that come with Gelatin do what they show, and nothing in them passes through
// anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/overlaps.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

class ContactScene {
public:
    explicit ContactScene(const std::string& name)
        : simulator_(load_scene(test::source_path() + "scenes/" + name), cpu()) {}

    // Looks for overlaps after every fifth frame.
    void advance_to(int frame) {
        while (simulator_.frame() < frame) {
            simulator_.advance_frame();
            now_ = simulator_.read_frame();
            if (simulator_.frame() % 5 != 0) continue;
            std::vector<cpu::Vec4<float>> positions;
            for (std::size_t n = 0; 3 * n < now_.positions.size(); ++n)
                positions.emplace_back(now_.positions[3 * n], now_.positions[3 * n + 1],
                                       now_.positions[3 * n + 2], 0.0f);
            const test::Overlaps which =
                simulator_.scene().collision.self_collision ? test::Overlaps::all : test::Overlaps::between;
            ASSERT_EQ(test::count_overlaps(model_of(simulator_), positions, which), 0u)
                << "frame " << simulator_.frame();
        }
    }

    glm::dvec3 center(std::size_t object) const { return mean(object, now_.positions); }
    glm::dvec3 velocity(std::size_t object) const { return mean(object, now_.velocities); }

    double fastest() const {
        double most = 0.0;
        for (std::size_t v = 0; v < now_.velocities.size(); v += 3)
            most = std::max(most, static_cast<double>(glm::length(glm::vec3(
                                      now_.velocities[v], now_.velocities[v + 1], now_.velocities[v + 2]))));
        return most;
    }

    // Of the nodes whose height is near y [m].
    glm::dvec3 extent_near_y(double y, double distance) const {
        glm::dvec3 low(1e9), high(-1e9);
        for (std::size_t n = 0; n < now_.positions.size(); n += 3) {
            const glm::dvec3 p(now_.positions[n], now_.positions[n + 1], now_.positions[n + 2]);
            if (std::abs(p.y - y) > distance) continue;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        return high - low;
    }

    FrameStatistics statistics() {
        simulator_.begin_statistics();
        return simulator_.take_statistics();
    }

private:
    static SimulatorOptions cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }
    glm::dvec3 mean(std::size_t object, const std::vector<float>& of) const {
        const Range& nodes = model_of(simulator_).objects[object].nodes;
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += glm::dvec3(of[3 * n], of[3 * n + 1], of[3 * n + 2]);
        return sum / static_cast<double>(nodes.count);
    }

    Simulator simulator_;
    HostFrame now_;
};

TEST(ContactScenesHeavy, ABallFallsThroughAFunnel) {
    ContactScene scene("funnel.toml");
    scene.advance_to(60);
    EXPECT_GT(scene.center(0).y, 0.5);
    scene.advance_to(300);
    EXPECT_LT(scene.center(0).y, 0.4);
}

TEST(ContactScenesHeavy, ARodPressesABallThroughARing) {
    ContactScene scene("squeeze.toml");
    scene.advance_to(70);
    EXPECT_GT(scene.center(0).y, 1.0);  // it is caught
    scene.advance_to(200);
    EXPECT_LT(scene.center(0).y, 0.6);
}

// Pulled along y, the knot draws together and stays: a bar without one is 0.15 m thick.
TEST(ContactScenesHeavy, AKnotIsPulledTight) {
    ContactScene scene("knot.toml");
    scene.advance_to(130);
    const glm::dvec3 loose = scene.extent_near_y(0.0, 0.6);
    scene.advance_to(330);
    const glm::dvec3 tight = scene.extent_near_y(0.0, 0.6);
    EXPECT_GT(loose.x, 0.6);
    EXPECT_LT(tight.x, 0.45);
    EXPECT_GT(tight.x, 0.3);
}

TEST(ContactScenesHeavy, PlatesCarryABall) {
    ContactScene scene("gripper.toml");
    scene.advance_to(165);
    EXPECT_NEAR(scene.center(0).y, 1.35, 0.05);
    // Friction carries the weight of the ball and what accelerates it.
    double lifting = 0.0;
    for (const ContactForce& force : scene.statistics().contact_forces)
        lifting += force.normal[1] + force.friction[1];
    EXPECT_GT(lifting, 300.0);
    scene.advance_to(400);
    EXPECT_GT(scene.center(0).x, 1.0);
    EXPECT_LT(scene.center(0).y, 1.0);  // it bounces
}

TEST(ContactScenesHeavy, BeltsCarryLettersIntoACrate) {
    ContactScene scene("conveyor.toml");
    scene.advance_to(600);
    for (const std::size_t object : {0, 1, 2, 3, 4}) {
        const glm::dvec3 center = scene.center(object);
        EXPECT_NEAR(center.x, 1.45, 0.6) << object;
        EXPECT_LT(center.y, 0.5) << object;
        EXPECT_NEAR(center.z, 2.6, 0.6) << object;
    }
}

TEST(ContactScenesHeavy, BlocksHoldAndSlideOnARamp) {
    ContactScene scene("ramp.toml");
    scene.advance_to(60);
    const glm::dvec3 held = scene.center(0);
    const double before = glm::length(scene.velocity(1));
    scene.advance_to(180);
    EXPECT_LT(glm::distance(scene.center(0), held), 1e-5);
    // 20 degrees, friction 0.33.
    EXPECT_NEAR((glm::length(scene.velocity(1)) - before) / 2.0, 9.81 * (0.34202 - 0.33 * 0.93969),
                0.02 * 9.81 * 0.33);
    EXPECT_GT(scene.center(2).x, 2.0);
}

TEST(ContactScenesHeavy, AStackStands) {
    ContactScene scene("stack.toml");
    scene.advance_to(300);
    EXPECT_LT(scene.fastest(), 1e-4);
    EXPECT_NEAR(scene.center(9).y, 0.80, 0.01);
}

TEST(ContactScenesLong, AStackStandsForTwentySeconds) {
    ContactScene scene("stack.toml");
    scene.advance_to(1200);
    EXPECT_LT(scene.fastest(), 1e-4);
}

TEST(ContactScenesLong, APileComesToRest) {
    ContactScene scene("pile.toml");
    double peak = 0.0;
    for (int frame = 10; frame <= 480; frame += 10) {
        scene.advance_to(frame);
        if (HasFatalFailure()) return;
        peak = std::max(peak, scene.statistics().kinetic_energy);
    }
    EXPECT_LT(scene.statistics().kinetic_energy, 1e-6 * peak);
    for (std::size_t object = 0; object < 60; ++object) {
        const glm::dvec3 center = scene.center(object);
        EXPECT_LT(std::max(std::abs(center.x), std::abs(center.z)), 1.0) << object;
        EXPECT_GT(center.y, 0.0) << object;
    }
}

}  // namespace
}  // namespace gelatin
