// A ball that flies farther in a step than a plate is thick: scenes/bullet.toml.
#include <gtest/gtest.h>

#include "gelatin/simulator.h"
#include "model/model.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

class BulletTest : public test::GlTest {
protected:
    // Where the middle of the ball's nodes is, across the plate, when it would have flown half a metre [m].
    static double place_of_ball(Backend backend) {
        const Scene scene = load_scene(GELATIN_SOURCE_DIR "/scenes/bullet.toml");
        SimulatorOptions options;
        options.backend = backend;
        options.use_current_context = true;
        Simulator simulator(scene, options);
        EXPECT_GT(300.0 * simulator.step_size(), 2 * 0.02) << "the step is too short to test anything";
        for (int frame = 0; frame < 10; ++frame) simulator.advance_frame();
        const Range& nodes = simulator.model().objects[1].nodes;
        const std::vector<float> positions = simulator.read_frame().positions;
        double sum = 0.0;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += static_cast<double>(positions[3 * n + 2]);
        return sum / nodes.count;
    }
};

TEST_F(BulletTest, IsStoppedByThePlate) {
    for (const Backend backend : {Backend::cpu, Backend::gl})
        EXPECT_GT(place_of_ball(backend), -0.1) << "the plate gives way a little";
}

}  // namespace
}  // namespace gelatin
