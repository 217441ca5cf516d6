// The volume term in explicit solvers.
#include "cpu/elasticity/volume_term.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "cpu/explicit/explicit_solver.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/implicit_euler.h"
#include "support/parity.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 1e-4;  // [s]

// Of fitted springs.
Model make_block_of(double poisson_ratio, double damping = 0.0) {
    Material material;
    material.poisson_ratio = poisson_ratio;
    material.damping = damping;
    Body body = test::make_body(test::make_block({5, 6, 4}, {0.5, 0.6, 0.4}, 0.2), material);
    body.velocity = {1.0, -2.0, 0.5};
    return test::make_model(body);
}

void shake(Model& model, float size, float speed) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (std::size_t n = 0; n < model.positions.size(); ++n) {
        for (int k = 0; k < 3; ++k) {
            model.positions[n][k] += size * normal(random);
            model.velocities[n][k] += speed * normal(random);
        }
    }
}

cpu::ExplicitSolver<double> solver_for(const Model& model, SolverKind kind, ForceMethod forces) {
    return {std::make_shared<const Model>(model), kind, forces};
}

// What one step changes about velocities is minus the gradient of the Newton reference's energy, which is
// written apart from it.
TEST(VolumeForces, AreTheGradientOfTheEnergy) {
    for (const double poisson_ratio : {0.0, 0.1, 0.4, 0.49}) {
        for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
            Model model = make_block_of(poisson_ratio);
            shake(model, 0.02f, 0.0f);
            for (glm::vec4& v : model.velocities) v = glm::vec4(0.0f);
            auto solver = solver_for(model, SolverKind::semi_implicit_euler, forces);
            solver.advance({kStep});
            const test::ImplicitEuler reference(model, 1.0);  // without inertia: the model rests
            const Eigen::VectorXd gradient = reference.gradient(reference.start());
            double scale = 0.0, worst = 0.0;
            for (std::uint32_t n = 0; n < model.node_count(); ++n) {
                const double mass = 1.0 / static_cast<double>(model.positions[n].w);
                const glm::dvec3 force = mass / kStep * glm::dvec3(solver.nodes().velocities[n]);
                for (int k = 0; k < 3; ++k) {
                    const double expected = -gradient[3 * static_cast<Eigen::Index>(n) + k];
                    scale = std::max(scale, std::abs(expected));
                    worst = std::max(worst, std::abs(force[k] - expected));
                }
            }
            EXPECT_LT(worst, 1e-10 * scale) << poisson_ratio;
        }
    }
}

class VolumeForcesTest : public ::testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, VolumeForcesTest, ::testing::ValuesIn(test::kExplicitSolvers),
                         [](const auto& test) { return name_of(test.param); });

TEST_P(VolumeForcesTest, FloatWithSimdMatchesTheOracle) {
    for (const double poisson_ratio : {0.0, 0.45}) {
        Model model = make_block_of(poisson_ratio, 2e-3);
        shake(model, 0.03f, 1.0f);
        ASSERT_NE(model.node_count() % 64, 0u);
        ASSERT_NE(model.node_count() % 8, 0u);
        EXPECT_LE(test::worst_simd_error(model, GetParam(), kStep), 1.0);
    }
}

TEST_P(VolumeForcesTest, KeepMomentum) {
    for (const double poisson_ratio : {0.0, 0.45}) {
        Model model = make_block_of(poisson_ratio, 1e-3);
        shake(model, 0.01f, 0.5f);
        auto solver = solver_for(model, GetParam(), ForceMethod::fused);
        const auto sums = [&] {
            glm::dvec3 linear(0.0), angular(0.0);
            for (std::uint32_t n = 0; n < model.node_count(); ++n) {
                const glm::dvec3 p =
                    glm::dvec3(solver.nodes().velocities[n]) / static_cast<double>(model.positions[n].w);
                linear += p;
                angular += glm::cross(glm::dvec3(solver.nodes().positions[n]), p);
            }
            return std::pair(linear, angular);
        };
        const auto [linear, angular] = sums();
        // What a scheme itself does to angular momentum goes with the square of the step at least.
        for (int s = 0; s < 100; ++s) solver.advance({1e-2 * kStep});
        const auto [linear_after, angular_after] = sums();
        const double scale = model.objects[0].mass * 2.5;
        EXPECT_LT(glm::length(linear_after - linear), 1e-12 * scale);
        EXPECT_LT(glm::length(angular_after - angular), 1e-5 * scale);
    }
}

// Symplectic, and stiff as the term makes it: in steps of a quarter of the largest stable one a mode's
// energy, as `measure` gives it, swings by omega h / 2 at most, a quarter; the sum of many modes by less than
// a tenth.
TEST(VolumeForces, KeepEnergy) {
    for (const double poisson_ratio : {0.0, 0.4, 0.49}) {
        Model model = make_block_of(poisson_ratio);
        shake(model, 1e-3f, 0.1f);
        auto solver = solver_for(model, SolverKind::semi_implicit_euler, ForceMethod::fused);
        const auto energy = [&] {
            solver.begin_measure();
            const ObjectMeasure sums = solver.end_measure().objects[0];
            return sums.kinetic_energy + sums.elastic_energy -
                   0.5 * glm::dot(sums.momentum, sums.momentum) / model.objects[0].mass;
        };
        const double step = 0.25 * largest_stable_step(SolverKind::semi_implicit_euler, model);
        const double start = energy();
        for (int s = 0; s < 500; ++s) solver.advance({step});
        EXPECT_NEAR(energy() / start, 1.0, 0.1) << poisson_ratio;
    }
}

}  // namespace
}  // namespace gelatin
