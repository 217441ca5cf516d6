// scenes/rain.toml with an explicit solver and fewer drops: it runs to its end, and the drops come to rest as
// drops. And a crowd of drops with contact, in steps of a frame and in divided ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "support/source_path.h"

namespace gelatin::rain_test {
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

struct Energies {
    double kinetic, potential;  // [J]
};

// 96 drops in a block come down together, bounce and spread. @param frames ascending
std::vector<Energies> fall(const std::string& substeps, const std::vector<int>& frames) {
    Scene scene =
        load_scene(test::source_path("scenes/rain.toml"),
                   {"simulation.substeps=" + substeps, "object.drop.shape.frequency=2",
                    "object.drop.position=[0, 1.6, 0]", "object.drop.velocity=[0, -4, 0]",
                    "object.drop.copies.counts=[4, 6, 4]", "object.drop.copies.spacing=[0.5, 0.45, 0.5]",
                    "object.drop.copies.jitter=0.02"});
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    std::vector<Energies> energies;
    for (const int frame : frames) {
        while (simulator.frame() < frame) simulator.advance_frame();
        simulator.begin_statistics();
        const FrameStatistics now = simulator.take_statistics();
        energies.push_back({now.kinetic_energy, now.potential_energy});
    }
    return energies;
}

// Few sweeps must find what many bodies do that meet at once. Where the first to meet stopped all of them,
// the block stayed above the floor and hardly spread.
TEST(RainHeavy, DropsOfACrowdDoNotStopEachOther) {
    const std::vector<int> frames{12, 20, 28};
    const std::vector<Energies> least = fall("8", frames);  // of what short steps with all sweeps leave
    for (const std::string substeps : {"1", "\"auto\""}) {
        const std::vector<Energies> energies = fall(substeps, frames);
        for (std::size_t k = 0; k < frames.size(); ++k) {
            EXPECT_GT(energies[k].kinetic, 0.5 * least[k].kinetic) << substeps << ' ' << frames[k];
            EXPECT_NEAR(energies[k].potential, least[k].potential, 0.12 * least[k].potential)
                << substeps << ' ' << frames[k];
        }
    }
}

}  // namespace
}  // namespace gelatin::rain_test
