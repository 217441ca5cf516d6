// A soft body that falls on thin legs: these are crushed until tets turn inside out.
#include <gtest/gtest.h>

#include <optional>

#include "gelatin/simulator.h"

namespace gelatin {
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

// A part of a divided step has a single sweep, which does not bring back what its first guess leaves out of
// the motion: it is hardly ever the tangled guess of the whole body.
TEST(SoftImpact, DividedStepsKeepTheMotionOfWhatIsCrushed) {
    EXPECT_GT(energy_left(false, std::nullopt), 0.9 * energy_left(false, 16));
}

// Nor that few of its nodes would leave their rooms in their body, or meet others of it.
TEST(SoftImpact, SoDoBodiesThatMeetThemselves) {
    EXPECT_GT(energy_left(true, std::nullopt), 0.7 * energy_left(true, 16));
}

}  // namespace
}  // namespace gelatin
