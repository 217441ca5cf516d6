// Scenes of random bodies, sizes, stiffnesses, velocities, steps and starts: nothing is ever not finite.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cpu/implicit/system_solver.h"
#include "model/assembly/start_state.h"
#include "support/test_models.h"

namespace gelatin::fuzz_test {
namespace {

class Random {
public:
    explicit Random(unsigned seed) : random_(seed) {}
    double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }
    double decades(double least, double most) {
        return std::pow(10.0, between(std::log10(least), std::log10(most)));
    }
    int number(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    glm::dvec3 direction() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }

private:
    std::mt19937 random_;
};

struct Fuzzed {
    std::shared_ptr<const Model> model;
    State start;
    double step;
    ImplicitSettings settings;
};

Fuzzed make_scene(unsigned seed) {
    Random random(seed);
    Fuzzed fuzzed;
    Scene scene;
    std::vector<Body> bodies;
    const int count = random.number(1, 3);
    for (int b = 0; b < count; ++b) {
        const double size = random.decades(1e-3, 1e2);
        const glm::ivec3 cells(random.number(1, 5), random.number(1, 5), random.number(1, 5));
        Body body = test::make_body(test::make_block(cells, size * glm::dvec3(cells), 0.1, seed));
        const glm::dvec3 place = 2.0 * size * static_cast<double>(b) * random.direction();
        for (glm::dvec3& p : body.mesh.positions) p += place;
        body.material.youngs_modulus = random.decades(1e3, 1e10);
        body.material.density = random.decades(10.0, 2e4);
        body.material.poisson_ratio = random.number(0, 1) == 0 ? 0.25 : random.between(0.0, 0.49);
        body.material.damping = random.number(0, 1) == 0 ? 0.0 : random.decades(1e-5, 1.0);
        if (random.number(0, 1) == 0) body.material.springs = SpringKinds{};
        body.velocity = random.decades(1e-2, 1e3) * random.direction();
        if (random.number(0, 2) == 0) body.pins = {SphereRegion{body.mesh.positions[0], 0.5 * size}};
        bodies.push_back(body);
        StartDescription start;
        if (random.number(0, 1) == 0)
            start.scale = {random.number(0, 1), random.number(0, 1), random.number(0, 2)};
        if (random.number(0, 2) == 0) start.scatter = size * random.decades(1e-3, 1e1);
        scene.objects.emplace_back().start = start;
    }
    // Bodies start outside colliders, not far from them.
    double lowest = 0.0;
    for (const Body& body : bodies) {
        for (const glm::dvec3& p : body.mesh.positions) lowest = std::min(lowest, p.y);
    }
    ColliderDescription floor, ball;
    floor.shape = PlaneCollider{{0, 1, 0}, lowest - random.decades(1e-3, 1.0)};
    floor.restitution = random.between(0, 1);
    const double radius = random.decades(1e-2, 10.0);
    ball.shape = SphereShape{radius};
    ball.position = {0.0, lowest - radius - random.decades(1e-3, 1.0), 0.0};
    fuzzed.model =
        std::make_shared<const Model>(pack_bodies(bodies, {floor, ball}, 10.0 * random.direction()));
    const std::optional<State> start = deformed_start(scene, *fuzzed.model);
    fuzzed.start = start ? *start : State{fuzzed.model->positions, fuzzed.model->velocities, {}};
    fuzzed.step = random.decades(1e-5, 1.0 / 30.0);
    fuzzed.settings = {random.number(1, 15)};
    return fuzzed;
}

void expect_finite(unsigned first, unsigned end) {
    for (unsigned seed = first; seed < end; ++seed) {
        const Fuzzed scene = make_scene(seed);
        cpu::SystemSolver<float> solver(scene.model, {}, scene.settings);
        solver.write_state(scene.start);
        for (int s = 0; s < 60; ++s) solver.advance({scene.step});
        const State state = solver.read_state();
        for (std::uint32_t n = 0; n < scene.model->node_count(); ++n) {
            for (int k = 0; k < 3; ++k) {
                ASSERT_TRUE(std::isfinite(state.positions[n][k]) && std::isfinite(state.velocities[n][k]))
                    << "scene " << seed << ", node " << n;
            }
        }
    }
}

TEST(Fuzz, NothingIsEverNotFinite) {
    expect_finite(0, 40);
}
// Seed 128: a body begins in one point.
TEST(Fuzz, BodiesInOnePointAreFinite) {
    expect_finite(128, 129);
}
TEST(FuzzLong, NothingIsEverNotFinite) {
    expect_finite(40, 1040);
}

}  // namespace
}  // namespace gelatin::fuzz_test
