// The paper's scenes (4.2), whole: 5,000 frames of a millisecond.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gelatin/simulator.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin::paper_scenes_test {
namespace {

struct PaperScene {
    const char* name;
    bool has_floor;
};

class PaperScenes : public test::GlTest {
protected:
    // Nothing leaves, nothing collapses, no number stops being one.
    static void play(const PaperScene& paper, Backend backend) {
        SCOPED_TRACE(std::string(paper.name) + (backend == Backend::gl ? " on GL" : " on the CPU"));
        const Scene scene = load_scene(test::source_path("scenes/") + paper.name + ".toml");
        ASSERT_EQ(scene.simulation.frames, 5000);
        ASSERT_EQ(scene.simulation.frame_rate, 1000.0);
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(scene, options);
        EXPECT_EQ(simulator.substeps(), 1);

        std::size_t frames_in_contact = 0;
        double smallest_volume = 1.0, largest_volume = 1.0, first_energy = 0.0, energy = 0.0;
        for (int frame = 0; frame <= 5000; frame += 20) {
            simulator.begin_statistics();
            const FrameStatistics now = simulator.take_statistics();  // throws where it is not finite
            energy = now.kinetic_energy + now.elastic_energy + now.potential_energy;
            if (frame == 0) first_energy = energy;
            EXPECT_LT(energy, first_energy + 0.001 * std::abs(first_energy)) << "frame " << frame;
            frames_in_contact += now.colliding_faces > 0 ? 1 : 0;
            EXPECT_LT(now.deepest_penetration, 1e-5);
            for (const double ratio : now.volume_ratio) {
                smallest_volume = std::min(smallest_volume, ratio);
                largest_volume = std::max(largest_volume, ratio);
            }
            for (int f = 0; f < 20 && frame < 5000; ++f) simulator.advance_frame();
        }
        EXPECT_GT(frames_in_contact, 5u) << "objects meet";
        EXPECT_GT(smallest_volume, 0.85);
        EXPECT_LT(largest_volume, 1.1);
        if (!paper.has_floor) return;
        EXPECT_LT(energy, 0.9 * first_energy) << "what falls and meets the floor loses energy";
    }
};

constexpr PaperScene kScenes[] = {{"free_fall", true}, {"paper_letters", true}, {"collision", false}};

class PaperScenesHeavy : public PaperScenes {};
class PaperScenesLong : public PaperScenes {};

TEST_F(PaperScenesHeavy, RunToTheirEndOnTheCpu) {
    for (const PaperScene& scene : kScenes) play(scene, Backend::cpu);
}

TEST_F(PaperScenesLong, RunToTheirEndOnGl) {
    for (const PaperScene& scene : kScenes) play(scene, Backend::gl);
}

}  // namespace
}  // namespace gelatin::paper_scenes_test
