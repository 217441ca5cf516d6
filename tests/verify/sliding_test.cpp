// Blocks on slopes, by Coulomb's law: from the least that slides on, as fast as that leaves of gravity.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "gelatin/simulator.h"
#include "support/simulator_fixture.h"

namespace gelatin::sliding_test {
namespace {

constexpr double kGravity = 9.81, kFriction = 0.5;

class SlidingTest : public test::SimulatorFixture {
protected:
    // A flat block of 16 kg and 0.4 m, or smaller by a scale, in gravity that is turned as the slope is.
    // @param tangent of the slope over the coefficient of friction
    static Scene scene(bool has_plane, double youngs_modulus, double tangent, double scale = 1.0) {
        Scene scene;
        const double angle = std::atan(tangent * kFriction);
        scene.simulation.gravity = {kGravity * std::sin(angle), -kGravity * std::cos(angle), 0.0};
        Material& material = scene.materials.emplace_back();
        material.name = "block";
        material.youngs_modulus = youngs_modulus;
        material.poisson_ratio = 0.3;
        ObjectDescription& block = scene.objects.emplace_back();
        block.name = "block";
        block.material = "block";
        block.shape = BoxShape{.size = scale * glm::dvec3(0.4, 0.1, 0.4), .segments = {4, 1, 4}};
        block.position = {0.0, scale * 0.0501, 0.0};
        ColliderDescription& ground = scene.colliders.emplace_back();
        ground.friction = kFriction;
        if (has_plane) {
            ground.shape = PlaneCollider{{0, 1, 0}, 0.0};
        } else {
            ground.shape = Shape{BoxShape{.size = {60.0, 1.0, 2.0}}};
            ground.position = {0.0, -0.5, 0.0};
        }
        return scene;
    }
    static double speed_after(Simulator& simulator, int frames, double scale = 1.0) {
        for (int frame = 0; frame < frames; ++frame) simulator.advance_frame();
        simulator.begin_statistics();
        return simulator.take_statistics().momentum[0] / (16.0 * scale * scale * scale);
    }
};

TEST_F(SlidingTest, FrictionHoldsBlocks) {
    for (const bool has_plane : {false, true})
        for (const double youngs_modulus : {1e4, 1e5, 1e6, 1e8}) {
            Simulator held(scene(has_plane, youngs_modulus, 0.98), on(Backend::cpu));
            EXPECT_LT(std::abs(speed_after(held, 180)), 1e-5) << has_plane << ' ' << youngs_modulus;
        }
    Simulator held(scene(true, 1e5, 0.98), on(Backend::gl));
    EXPECT_LT(std::abs(speed_after(held, 180)), 1e-5);
}

TEST_F(SlidingTest, BlocksSlideAsFastAsFrictionLeaves) {
    for (const bool has_plane : {false, true})
        for (const double youngs_modulus : {1e4, 1e5, 1e6, 1e7, 1e8, 1e9})
            for (const double tangent : {1.02, 1.3, 2.0}) {
                const Scene slope = scene(has_plane, youngs_modulus, tangent);
                const glm::dvec3 gravity = slope.gravity();
                const double friction = -kFriction * gravity.y;
                for (const Backend backend : {Backend::cpu, Backend::gl}) {
                    if (backend == Backend::gl && (youngs_modulus != 1e7 || tangent < 1.1))
                        continue;  // to save time
                    Simulator block(slope, on(backend));
                    const double before = speed_after(block, 60), after = speed_after(block, 60);
                    EXPECT_NEAR(after - before, gravity.x - friction, (has_plane ? 0.003 : 0.04) * friction)
                        << has_plane << ' ' << youngs_modulus << ' ' << tangent;
                }
            }
}

// Of small ones, all of what gravity adds in a step is far more than contacts reach.
TEST_F(SlidingTest, SmallBlocksSlideAsFast) {
    for (const double scale : {0.1, 0.05}) {
        for (const double youngs_modulus : {1e5, 1e6}) {
            const Scene slope = scene(false, youngs_modulus, 1.3, scale);
            const glm::dvec3 gravity = slope.gravity();
            Simulator block(slope, on(Backend::cpu));
            const double before = speed_after(block, 60, scale), after = speed_after(block, 60, scale);
            EXPECT_NEAR(after - before, gravity.x + kFriction * gravity.y, -0.02 * kFriction * gravity.y)
                << scale << ' ' << youngs_modulus;
        }
    }
}

}  // namespace
}  // namespace gelatin::sliding_test
