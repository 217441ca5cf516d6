// Explicit steps of neo-Hookean bodies, beside bodies of springs.
#include <gtest/gtest.h>

#include "cpu/explicit/explicit_solver.h"
#include "cpu/explicit/gather_forces.h"
#include "cpu/measure/measure.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/parity.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kTetStep = 2e-4;  // [s]

class NeoHookeanStepTest : public ::testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, NeoHookeanStepTest, ::testing::ValuesIn(test::kExplicitSolvers),
                         [](const auto& test) { return name_of(test.param); });

TEST_P(NeoHookeanStepTest, FloatWithSimdMatchesTheOracle) {
    for (const double damping : {0.0, 2e-3}) {
        const Model model = test::make_lively_tets(damping);
        ASSERT_NE(model.node_count() % 64, 0u);
        EXPECT_LE(test::worst_simd_error(model, GetParam(), kTetStep), 1.0);
    }
}

TEST_P(NeoHookeanStepTest, DivideAndMergeIsTheSameAsFused) {
    const auto model = std::make_shared<const Model>(test::make_lively_tets(2e-3));
    cpu::ExplicitSolver<double> fused(model, GetParam(), ForceMethod::fused);
    cpu::ExplicitSolver<double> divided(model, GetParam(), ForceMethod::divide_and_merge);
    for (int s = 0; s < 3; ++s) {
        fused.advance({kTetStep});
        divided.advance({kTetStep});
    }
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        EXPECT_LT(glm::distance(fused.nodes().positions[n], divided.nodes().positions[n]), 1e-13);
        EXPECT_LT(glm::distance(fused.nodes().velocities[n], divided.nodes().velocities[n]), 1e-10);
    }
}

Material neo_hookean(double poisson_ratio, double damping = 0.0) {
    Material material;
    material.model = MaterialModel::neo_hookean;
    material.poisson_ratio = poisson_ratio;
    material.damping = damping;
    return material;
}

Model make_quivering_block(double poisson_ratio, double damping) {
    Model model = test::make_model(test::make_body(test::make_block({6, 5, 4}, {1.2, 1.0, 0.8}, 0.3),
                                                   neo_hookean(poisson_ratio, damping)));
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        model.velocities[n].x = 1e-3f * static_cast<float>(n % 7) - 3e-3f;
    return model;
}

double energy_after(const Model& model, SolverKind kind, double step, int steps) {
    cpu::ExplicitSolver<double> solver(std::make_shared<const Model>(model), kind, ForceMethod::fused);
    for (int s = 0; s < steps; ++s) solver.advance({step});
    solver.begin_measure();
    const ObjectMeasure sums = solver.end_measure().objects[0];
    return sums.kinetic_energy + sums.elastic_energy;
}

// At the largest stable step energy stays, at twice that it grows without limit.
TEST(NeoHookeanStepHeavy, LargestStableStepSeparatesQuietFromExploding) {
    for (const double nu : {0.0, 0.25, 0.45, 0.49}) {
        for (const double damping : {0.0, 1e-3}) {
            const Model model = make_quivering_block(nu, damping);
            for (const SolverKind kind : {SolverKind::semi_implicit_euler, SolverKind::rk4}) {
                const double step = largest_stable_step(kind, model);
                const double start = energy_after(model, kind, step, 0);
                EXPECT_LT(energy_after(model, kind, step, 300), 2.0 * start) << nu << ", " << damping << " s";
                EXPECT_FALSE(energy_after(model, kind, 2.0 * step, 300) < 100.0 * start)
                    << nu << ", " << damping << " s, or NaN by then";
            }
        }
    }
}

// The bound is that of the true highest frequency, found by power iteration on the model's own forces.
TEST(NeoHookeanStep, FrequencyBoundIsAboveTheHighestFrequency) {
    const Model model = make_quivering_block(0.4, 0.0);
    const auto forces = [&](const std::vector<glm::dvec3>& moves) {
        cpu::Nodes<double> at, out, sums;
        for (std::uint32_t n = 0; n < model.node_count(); ++n)
            at.positions.emplace_back(glm::dvec3(model.positions[n]) + moves[n], 0.0);
        at.velocities.resize(at.positions.size());
        std::vector<double> stresses;
        for (std::uint32_t n = 0; n < model.node_count(); ++n)
            stresses.push_back(cpu::volume_stress_round(model.volume_term, n, at.positions.data()));
        auto pass = cpu::make_pass(model, explicit_scheme(SolverKind::semi_implicit_euler), 0, 1.0, at, at,
                                   out, sums);
        pass.volume_stresses = stresses.data();
        std::vector<glm::dvec3> result;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) result.push_back(cpu::gather_forces(pass, n));
        return result;
    };
    const std::vector<glm::dvec3> rest = forces(std::vector<glm::dvec3>(model.node_count()));
    std::vector<glm::dvec3> mode;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        mode.emplace_back(n % 3 - 1.0, n % 5 - 2.0, n % 7 - 3.0);
    double squared_frequency = 0.0;
    for (int i = 0; i < 300; ++i) {
        double size = 0.0;
        for (const glm::dvec3& m : mode) size += glm::dot(m, m);
        for (glm::dvec3& m : mode) m *= 1e-6 / std::sqrt(size);
        const std::vector<glm::dvec3> now = forces(mode);
        double up = 0.0;
        for (std::uint32_t n = 0; n < model.node_count(); ++n) {
            mode[n] = -(now[n] - rest[n]) * static_cast<double>(model.positions[n].w);
            up += glm::dot(mode[n], mode[n]);
        }
        squared_frequency = std::sqrt(up) / 1e-6;
    }
    const double bound = frequency_bound(model, model.objects[0]);
    EXPECT_GT(bound, std::sqrt(squared_frequency));
    EXPECT_LT(bound, 1.8 * std::sqrt(squared_frequency));
}

TEST(NeoHookeanStep, BodiesOfSpringsBesideThemAreAsTheyWouldBeAlone) {
    Body springs = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    const Body tets = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2), neo_hookean(0.4));
    Model alone = pack_bodies({springs}, {}, {}), both = pack_bodies({springs, tets}, {}, {});
    for (Model* model : {&alone, &both}) {
        for (std::uint32_t n = 0; n < alone.node_count(); ++n)
            model->positions[n].x *= 1.0f + 0.01f * static_cast<float>(n % 5);
    }
    const cpu::Nodes<double> one = test::oracle_step(alone, SolverKind::semi_implicit_euler, kTetStep),
                             two = test::oracle_step(both, SolverKind::semi_implicit_euler, kTetStep);
    for (std::uint32_t n = 0; n < alone.node_count(); ++n) EXPECT_EQ(one.positions[n], two.positions[n]);
    EXPECT_NE(one.positions[5], glm::dvec4(alone.positions[5]));
}

// Stretched evenly by s along x, W / V is what the formula gives by hand.
TEST(NeoHookeanStep, ElasticEnergyIsMeasured) {
    Model model = test::make_model(
        test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2), neo_hookean(0.25)));
    const double stretch = 1.25;
    for (glm::vec4& p : model.positions) p.x *= static_cast<float>(stretch);
    const double mu = 4.0 / 3.0 * 5e4 / 2.5, lambda = 5e4 / 2.5 * (1.0 + 5.0 / 6.0);  // E = 5e4 Pa
    const double squares = stretch * stretch + 2.0;
    const double expected = 0.027 * (0.5 * mu * (squares - 3.0 - std::log((squares + 1.0) / 4.0)) -
                                     0.75 * mu * (stretch - 1.0) + 0.5 * lambda * std::pow(stretch - 1.0, 2));
    const auto measured = cpu::measure<double>(model, {{model.positions.begin(), model.positions.end()},
                                                       {model.velocities.begin(), model.velocities.end()}});
    EXPECT_NEAR(measured[0].elastic_energy / expected, 1.0, 1e-5);
}

}  // namespace
}  // namespace gelatin
