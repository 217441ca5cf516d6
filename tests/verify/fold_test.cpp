// scenes/fold.toml with an explicit solver: the halves of a bar swing against one another.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "sim/simulator_internals.h"
#include "support/source_path.h"

namespace gelatin::fold_test {
namespace {

constexpr int kFrames = 48;

struct Swing {
    double least_gap = 1e9;  // of the middles of the bar's ends, from left to right [m]
    std::size_t colliding_faces = 0;
};

Swing fold(bool self_collision) {
    const Scene scene = load_scene(
        test::source_path() + "scenes/fold.toml",
        {"simulation.solver=semi_implicit_euler", "collision.response=restore", "collision.restitution=0.1",
         std::string("collision.self_collision=") + (self_collision ? "true" : "false")});
    SimulatorOptions options;
    options.backend = Backend::cpu;
    Simulator simulator(scene, options);
    const std::vector<glm::vec4>& start = model_of(simulator).positions;
    Swing swing;
    for (int f = 0; f < kFrames; ++f) {
        simulator.advance_frame();
        simulator.begin_statistics();
        swing.colliding_faces += simulator.take_statistics().colliding_faces;
        const HostFrame frame = simulator.read_frame();
        double left = 0.0, right = 0.0, lefts = 0.0, rights = 0.0;
        for (std::size_t n = 0; n < start.size(); ++n) {
            const auto x = static_cast<double>(frame.positions[3 * n]);
            if (start[n].x < -1.1f) left += x, ++lefts;
            if (start[n].x > 1.1f) right += x, ++rights;
        }
        swing.least_gap = std::min(swing.least_gap, right / rights - left / lefts);
    }
    return swing;
}

TEST(FoldHeavy, HalvesOfABarDoNotPassThroughEachOther) {
    const Swing with = fold(true), without = fold(false);
    EXPECT_GT(with.colliding_faces, 500u);
    EXPECT_GT(with.least_gap, 0.04);  // half of the bar's thickness
    EXPECT_EQ(without.colliding_faces, 0u);
    EXPECT_LT(without.least_gap, -0.1);
}

}  // namespace
}  // namespace gelatin::fold_test
