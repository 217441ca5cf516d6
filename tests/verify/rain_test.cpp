// scenes/rain.toml with an explicit solver and fewer drops: it runs to its end, and the drops come to rest as
// drops.
#include <gtest/gtest.h>

#include <algorithm>

#include "gelatin/simulator.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

TEST(RainHeavy, DropsComeToRestWhole) {
    const Scene scene = load_scene(
        test::source_path("scenes/rain.toml"),
        {"simulation.solver=semi_implicit_euler", "simulation.substeps=\"auto\"",
         "collision.response=restore", "collision.restitution=0.2", "object.drop.copies.counts=[3, 4, 3]"});
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    ASSERT_EQ(simulator.counts().objects, 36u);
    double most_kinetic = 0.0;
    std::size_t most_colliding = 0;
    FrameStatistics now;
    while (simulator.frame() < scene.simulation.frames) {
        simulator.advance_frame();
        simulator.begin_statistics();
        now = simulator.take_statistics();
        most_kinetic = std::max(most_kinetic, now.kinetic_energy);
        most_colliding = std::max(most_colliding, now.colliding_faces);
        EXPECT_LT(now.deepest_penetration, 1e-5) << "a drop is in the floor";
    }
    EXPECT_GT(most_colliding, 20u) << "the drops never met";
    EXPECT_LT(now.kinetic_energy, 0.02 * most_kinetic);
    for (std::size_t o = 0; o < now.volume_ratio.size(); ++o)
        EXPECT_NEAR(now.volume_ratio[o], 1.0, 0.1) << "drop " << o + 1 << " stayed dented";
}

}  // namespace
}  // namespace gelatin
