// Bodies that start squashed to a plane, a line or a point, or with their nodes at random, find their shape
// again, at 60 steps a second and any stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "cpu/implicit/system_solver.h"
#include "gelatin/simulator.h"
#include "gpu/implicit/implicit_solver.h"
#include "mesh/shapes.h"
#include "mesh/tetrahedralise.h"
#include "model/assembly/start_state.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin::recovery_test {
namespace {

constexpr double kFrame = 1.0 / 60.0;  // [s]

TetMesh make_ball() {
    return tetrahedralise(make_sphere({0.5, 6}), {}, "ball");
}

TetMesh make_letter() {
    TextShape text;
    text.text = "R";
    text.depth = 0.3;
    MesherSettings mesher;
    mesher.max_volume = 1e-3;
    return tetrahedralise(make_text(text), mesher, "letter");
}

struct Squashed {
    const char* name;
    StartDescription start;
};

const Squashed kStarts[] = {{"plane", {{1, 0, 1}, 0.0}},
                            {"line", {{1, 0, 0}, 0.0}},
                            {"point", {{0, 0, 0}, 0.0}},
                            {"random", {{0, 0, 0}, 0.5}}};

// The largest difference of a spring from its rest length, over that.
double worst_strain(const Model& model, const std::vector<glm::vec4>& positions) {
    double worst = 0.0;
    for (const Spring& s : model.springs) {
        const double length = glm::distance(glm::dvec3(positions[s.i]), glm::dvec3(positions[s.j]));
        worst = std::max(worst, std::abs(length / static_cast<double>(s.rest_length) - 1.0));
    }
    return worst;
}

Body make_soft_body(const TetMesh& mesh, double youngs_modulus) {
    Body body = test::make_body(mesh);
    body.material.youngs_modulus = youngs_modulus;
    body.material.damping = 0.02 * std::sqrt(1e5 / std::min(youngs_modulus, 1e5));  // soft ones swing slowly
    return body;
}

struct Run {
    std::size_t count = 1;  // of bodies, each of which starts with random numbers of its own
    int frames = 10;
    Backend backend = Backend::cpu;
};

std::unique_ptr<Solver> make_solver(const std::shared_ptr<const Model>& model, Backend backend) {
    constexpr ImplicitSettings kSettings{20};
    if (backend == Backend::gl)
        return std::make_unique<gpu::ImplicitSolver>(model, CollisionSettings{}, kSettings);
    return std::make_unique<cpu::SystemSolver<float>>(model, CollisionSettings{}, kSettings);
}

double strain_after(const Run& run, const Body& body, const StartDescription& start) {
    const auto model =
        std::make_shared<const Model>(pack_bodies(std::vector<Body>(run.count, body), {}, {0, 0, 0}));
    Scene scene;
    scene.objects.resize(run.count);
    for (ObjectDescription& object : scene.objects) object.start = start;
    const std::unique_ptr<Solver> solver = make_solver(model, run.backend);
    solver->write_state(*deformed_start(scene, *model));
    for (int s = 0; s < run.frames; ++s) solver->advance({kFrame});
    return worst_strain(*model, solver->read_state().positions);
}

void expect_recovery(const TetMesh& mesh, double youngs_modulus) {
    const int frames = youngs_modulus < 1e5 ? 3600 : 600;
    for (const Squashed& squashed : kStarts) {
        EXPECT_LT(strain_after({1, frames}, make_soft_body(mesh, youngs_modulus), squashed.start), 0.01)
            << youngs_modulus << " Pa, from a " << squashed.name;
    }
}

// From places that say nothing of the shape a body of any stiffness is back within a few frames, always.
void expect_quick_recovery(const TetMesh& mesh, std::size_t count) {
    for (const double youngs_modulus : {1e3, 1e4, 1e5, 1e6, 1e7, 1e9}) {
        for (const StartDescription& start : {StartDescription{{0, 0, 0}, 0.5}, {{0, 0, 0}, 1e-6}}) {
            EXPECT_LT(strain_after({count}, make_soft_body(mesh, youngs_modulus), start), 0.01)
                << youngs_modulus << " Pa, scattered by " << start.scatter << " m";
        }
    }
}

TEST(Recovery, OfBlocksThatHaveLostTheirShape) {
    expect_quick_recovery(test::make_block({5, 4, 5}, {0.3, 0.24, 0.3}, 0.2), 20);
}
TEST(Recovery, OfBallsThatHaveLostTheirShape) {
    expect_quick_recovery(make_ball(), 5);
}
TEST(Recovery, OfLettersThatHaveLostTheirShape) {
    expect_quick_recovery(make_letter(), 5);
}

class RecoveryOnGl : public test::GlTest {};

TEST_F(RecoveryOnGl, OfABlockThatHasLostItsShape) {
    const TetMesh mesh = test::make_block({3, 3, 3}, {0.3, 0.24, 0.3}, 0.2);
    for (const double youngs_modulus : {1e3, 1e9}) {
        EXPECT_LT(strain_after({1, 3, Backend::gl}, make_soft_body(mesh, youngs_modulus), {{0, 0, 0}, 0.5}),
                  0.01);
    }
}

class RecoveryHeavy : public ::testing::TestWithParam<double> {};
class RecoveryLong : public RecoveryHeavy {};
INSTANTIATE_TEST_SUITE_P(Moduli, RecoveryHeavy, ::testing::Values(1e5));
INSTANTIATE_TEST_SUITE_P(Moduli, RecoveryLong, ::testing::Values(1e3, 1e4, 1e6, 1e7, 1e8, 1e9));

TEST_P(RecoveryHeavy, OfABall) {
    expect_recovery(make_ball(), GetParam());
}
TEST_P(RecoveryLong, OfABall) {
    expect_recovery(make_ball(), GetParam());
}
TEST_P(RecoveryLong, OfALetter) {
    expect_recovery(make_letter(), GetParam());
}

}  // namespace
}  // namespace gelatin::recovery_test
