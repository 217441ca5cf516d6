// One body over a plane: with contacts, which it has with itself, it bounces and rests as one among others.
#include <gtest/gtest.h>

#include <algorithm>

#include "gelatin/simulator.h"
#include "support/simulator_fixture.h"

namespace gelatin::single_body_test {
namespace {

class SingleBodyTest : public test::SimulatorFixture {
protected:
    static Scene scene(double youngs_modulus, double height) {
        Scene scene;
        Material& material = scene.materials.emplace_back();
        material.name = "material";
        material.youngs_modulus = youngs_modulus;
        ObjectDescription block;
        block.name = "block";
        block.shape = BoxShape{.size = glm::dvec3(0.4), .segments = glm::ivec3(3)};
        block.material = "material";
        block.position = {0.0, 0.2 + height, 0.0};
        scene.objects.push_back(block);
        ColliderDescription& floor = scene.colliders.emplace_back();
        floor.shape = PlaneCollider{};
        floor.restitution = 0.9;
        return scene;
    }
    static double upward_momentum(Simulator& simulator) {
        simulator.begin_statistics();
        return simulator.take_statistics().momentum[1];
    }
};

// Of a stiff body, implicit steps leave hardly anything to bounce with.
TEST_F(SingleBodyTest, BouncesByItsRestitution) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator block(scene(1e8, 0.5), on(backend));
        double lowest = 0.0, highest = 0.0;
        for (int frame = 0; frame < 40; ++frame) {
            block.advance_frame();
            const double momentum = upward_momentum(block);
            if (momentum < lowest) highest = lowest = momentum;
            highest = std::max(highest, momentum);
        }
        const double gained = 64.0 * 9.81 / 60.0;  // in a frame, before it meets the floor
        EXPECT_GT(highest, 0.85 * -lowest);
        EXPECT_LT(highest, 0.91 * (-lowest + gained));
    }
}

TEST_F(SingleBodyTest, FallsAsleep) {
    for (const Backend backend : {Backend::cpu, Backend::gl}) {
        Simulator block(scene(1e5, 0.001), on(backend));
        for (int frame = 0; frame < 240; ++frame) block.advance_frame();
        const std::vector<float> before = block.read_frame().positions;
        block.advance_frame();
        const HostFrame after = block.read_frame();
        EXPECT_EQ(after.positions, before);
        EXPECT_TRUE(
            std::all_of(after.velocities.begin(), after.velocities.end(), [](float v) { return v == 0.0f; }));
    }
}

}  // namespace
}  // namespace gelatin::single_body_test
