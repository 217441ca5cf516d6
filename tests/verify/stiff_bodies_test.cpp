// Stiff bodies among planes, of which few sweeps do not find how they are deformed: they gain no motion, and
// rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gelatin/simulator.h"
#include "support/random_maker.h"
#include "support/simulator_fixture.h"

namespace gelatin::stiff_bodies_test {
namespace {

class StiffBodiesTest : public test::SimulatorFixture {
protected:
    static Scene scene(double youngs_modulus, double restitution) {
        Scene scene;
        Material& material = scene.materials.emplace_back();
        material.name = "stiff";
        material.youngs_modulus = youngs_modulus;
        material.poisson_ratio = 0.3;
        scene.collision.restitution = restitution;
        return scene;
    }
    static void add_plane(const glm::dvec3& normal, double offset, double friction, Scene& scene) {
        ColliderDescription& plane = scene.colliders.emplace_back();
        plane.shape = PlaneCollider{normal, offset};
        plane.restitution = scene.collision.restitution;
        plane.friction = friction;
    }
    // Of all but contacts, after each frame from the start on.
    static std::vector<double> energies_of(Simulator& simulator, int frames) {
        std::vector<double> energies;
        for (int frame = 0; frame <= frames; ++frame) {
            if (frame > 0) simulator.advance_frame();
            simulator.begin_statistics();
            const FrameStatistics statistics = simulator.take_statistics();
            energies.push_back(statistics.kinetic_energy + statistics.potential_energy +
                               statistics.elastic_energy);
        }
        return energies;
    }
};

// Eight balls in a box of planes, without gravity and friction.
TEST_F(StiffBodiesTest, BilliardBallsGainNoMotion) {
    for (const double youngs_modulus : {1e7, 1e8})
        for (const double restitution : {0.0, 1.0}) {
            Scene box = scene(youngs_modulus, restitution);
            box.simulation.gravity = {0, 0, 0};
            box.collision.friction = 0.0;
            test::RandomMaker random(8);
            for (int i = 0; i < 8; ++i) {
                ObjectDescription& ball = box.objects.emplace_back();
                ball.name = "ball" + std::to_string(i);
                ball.shape = SphereShape{.radius = 0.2, .frequency = 3};
                ball.material = "stiff";
                ball.position = 0.9 * glm::dvec3(i % 2, i / 2 % 2, i / 4) - 0.45;
                ball.velocity = random.point(2.0);
            }
            for (int axis = 0; axis < 3; ++axis)
                for (const double side : {-1.0, 1.0}) {
                    glm::dvec3 normal(0.0);
                    normal[axis] = side;
                    add_plane(normal, -1.0, 0.0, box);
                }
            for (const Backend backend : {Backend::cpu, Backend::gl}) {
                Simulator balls(box, on(backend));
                const std::vector<double> energies = energies_of(balls, backend == Backend::cpu ? 240 : 60);
                for (std::size_t i = 1; i < energies.size(); ++i) {
                    const std::size_t first = restitution > 0.0 || i < 12 ? 0 : i - 12;
                    const double before = *std::max_element(energies.data() + first, energies.data() + i);
                    EXPECT_LT(energies[i], 1.02 * before)
                        << youngs_modulus << ' ' << restitution << " frame " << i;
                }
            }
        }
}

// They land on edges and corners, and friction stops them there too.
TEST_F(StiffBodiesTest, SingleOnesFallAndStop) {
    test::RandomMaker random(8);
    for (int number = 0; number < 24; ++number) {
        Scene falling = scene(random.magnitude(2e7, 2e9), number % 2 == 0 ? 0.6 : 0.0);
        ObjectDescription& body = falling.objects.emplace_back();
        body.name = "body";
        body.material = "stiff";
        body.position = {random.uniform(-0.1, 0.1), 0.6, random.uniform(-0.1, 0.1)};
        if (number % 3 == 0) {
            body.shape = BoxShape{.size = {1.0, 0.1, 0.1}, .segments = {10, 1, 1}};
        } else {
            body.shape = BoxShape{.size = {0.6, 0.2, 0.3}, .segments = {4, 2, 2}};
        }
        body.rotation = random.point(90.0);
        body.velocity = {0.0, 0.0, number % 4 == 0 ? 1.0 : 0.0};
        add_plane({0, 1, 0}, 0.0, 0.5, falling);
        Simulator simulated(falling, on(Backend::cpu));
        const std::vector<double> energies = energies_of(simulated, 300);
        simulated.begin_statistics();
        EXPECT_LT(simulated.take_statistics().kinetic_energy, 1e-6) << number;
        for (std::size_t i = 1; i < energies.size(); ++i) {
            const std::size_t first = i < 20 ? 0 : i - 20;  // less in the midst of an impact
            const double before = *std::max_element(energies.data() + first, energies.data() + i);
            EXPECT_LT(energies[i], before + 0.003 * energies[0]) << number << " frame " << i;
        }
    }
}

// They fall on the floor at an angle, and on each other.
TEST_F(StiffBodiesTest, BarsFallAndRest) {
    for (const double youngs_modulus : {1e8, 1.5e9}) {
        Scene bars = scene(youngs_modulus, 0.0);
        bars.collision.friction = 0.5;
        for (int i = 0; i < 3; ++i) {
            ObjectDescription& bar = bars.objects.emplace_back();
            bar.name = "bar" + std::to_string(i);
            bar.shape = BoxShape{.size = {1.0, 0.1, 0.1}, .segments = {10, 1, 1}};
            bar.material = "stiff";
            bar.position = {-0.05 * i, 0.6 + 1.2 * i, -0.03 * i};
            if (i == 0) bar.rotation = {87, 54, 60};
        }
        add_plane({0, 1, 0}, 0.0, 0.5, bars);
        for (const Backend backend : {Backend::cpu, Backend::gl}) {
            if (backend == Backend::gl && youngs_modulus > 1e9) continue;  // to save time
            Simulator falling(bars, on(backend));
            const std::vector<double> energies = energies_of(falling, 420);
            double least = energies[0];
            for (const double energy : energies) {
                EXPECT_LT(energy, least + 0.003 * energies[0]) << youngs_modulus;
                least = std::min(least, energy);
            }
            // A bar may stand on its end for a while.
            const auto kinetic = [&] {
                falling.begin_statistics();
                return falling.take_statistics().kinetic_energy;
            };
            while (falling.frame() < 720 && !(kinetic() < 1e-4)) falling.advance_frame();
            EXPECT_LT(kinetic(), 1e-4) << youngs_modulus;
        }
    }
}

// Half a millimetre and a millimetre across: their whole fall is less than 2e-9 J.
TEST_F(StiffBodiesTest, SmallBallsComeToRest) {
    for (const double radius : {0.00025, 0.0005}) {
        Scene small = scene(1e6, 0.0);
        add_plane({0.0, 1.0, 0.0}, 0.0, 0.5, small);
        ObjectDescription& ball = small.objects.emplace_back();
        ball.name = "ball";
        ball.shape = SphereShape{.radius = radius, .frequency = 4};
        ball.material = "stiff";
        ball.position = {0.0, 1.6 * radius, 0.0};
        ball.rotation = {0.0, 10.0, 20.0};
        Simulator simulator(small, on(Backend::cpu));
        const std::vector<double> energies = energies_of(simulator, 120);
        EXPECT_LE(*std::max_element(energies.begin(), energies.end()), 1.01 * energies[0]) << radius;
        simulator.begin_statistics();
        EXPECT_EQ(simulator.take_statistics().kinetic_energy, 0.0) << radius;  // asleep
    }
}

}  // namespace
}  // namespace gelatin::stiff_bodies_test
