// A soft body that falls on thin legs: these are crushed until tets turn inside out.
#include <gtest/gtest.h>

#include <optional>

#include "gelatin/simulator.h"

namespace gelatin::soft_impact_test {
namespace {

constexpr int kFrames = 5;  // until it is half way down

Scene thin_legs() {
    Scene scene;
    Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.youngs_modulus = 2e4;
    ObjectDescription legs;
    legs.name = "legs";
    legs.shape = TextShape{.text = "M", .depth = 0.3};
    legs.mesher.kind = MesherKind::lattice;
    legs.mesher.nodes = 1200;
    legs.material = "jelly";
    legs.position = {0, 0.3, 0};
    legs.velocity = {0, -4, 0};
    scene.objects.push_back(legs);
    scene.colliders.emplace_back().shape = PlaneCollider{};
    return scene;
}

// Kinetic and elastic [J].
double energy_left(bool meets_itself, std::optional<int> substeps) {
    Scene scene = thin_legs();
    scene.collision.self_collision = meets_itself;
    scene.simulation.substeps = substeps;
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    for (int frame = 0; frame < kFrames; ++frame) simulator.advance_frame();
    simulator.begin_statistics();
    const FrameStatistics now = simulator.take_statistics();
    return now.kinetic_energy + now.elastic_energy;
}

// An adaptive substep has a single sweep, which does not bring back what its prediction leaves out of
// the motion: it is hardly ever the tangled guess of the whole body.
TEST(SoftImpact, DividedStepsKeepTheMotionOfWhatIsCrushed) {
    EXPECT_GT(energy_left(false, std::nullopt), 0.9 * energy_left(false, 16));
}

// Nor that few of its nodes would exceed their displacement bounds, or meet others of it.
TEST(SoftImpact, SoDoBodiesThatMeetThemselves) {
    EXPECT_GT(energy_left(true, std::nullopt), 0.7 * energy_left(true, 16));
}

// In two soft balls that meet, a single sweep does not find deformations that go on from part to part. With
// them in its guess 0.77 of all energy is left, without 0.74.
TEST(SoftImpact, BallsThatMeetGoOnWithTheirDeformations) {
    Scene scene;
    scene.simulation.gravity = {0, 0, 0};
    Material& jelly = scene.materials.emplace_back();
    jelly.name = "jelly";
    jelly.youngs_modulus = 2e4;
    jelly.poisson_ratio = 0.3;
    jelly.density = 191;
    for (const bool is_large : {true, false}) {
        ObjectDescription ball;
        ball.name = is_large ? "large" : "small";
        ball.shape = SphereShape{.radius = is_large ? 0.5 : 0.25, .frequency = is_large ? 14 : 7};
        ball.material = "jelly";
        ball.position = {is_large ? -0.6 : 0.3, 0, 0};
        ball.velocity = {is_large ? 1.0 : -2.0, 0, 0};
        scene.objects.push_back(ball);
    }
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    const auto energy = [&] {
        simulator.begin_statistics();
        const FrameStatistics now = simulator.take_statistics();
        return now.kinetic_energy + now.elastic_energy;
    };
    const double before = energy();
    for (int frame = 0; frame < 45; ++frame) simulator.advance_frame();
    EXPECT_GT(energy(), 0.755 * before);
}

}  // namespace
}  // namespace gelatin::soft_impact_test
