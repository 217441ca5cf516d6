#include "cpu/explicit/advance_nodes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <random>

#include "cpu/cpu_solver.h"
#include "cpu/elasticity/spring_force.h"
#include "model/setting_names.h"
#include "support/parity.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

constexpr double kStep = 2e-4;  // [s]

class AdvanceNodesTest : public ::testing::TestWithParam<SolverKind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, AdvanceNodesTest, ::testing::ValuesIn(test::kExplicitSolvers),
                         [](const auto& test) { return name_of(test.param); });

// SIMD against the double oracle: wrong lanes, tails or transposes would be off by far more than rounding.
TEST_P(AdvanceNodesTest, FloatWithSimdMatchesTheOracle) {
    for (const Model& model : {test::make_lively_model(), test::make_driven_model()}) {
        ASSERT_NE(model.node_count() % 64, 0u);
        EXPECT_LE(test::worst_simd_error(model, GetParam(), kStep), 1.0);
    }
}

// A node without inverse mass moves with its velocity, straight, whatever pulls and presses.
TEST_P(AdvanceNodesTest, HeldNodesMoveWithTheirVelocity) {
    const auto model = std::make_shared<const Model>(test::make_driven_model());
    cpu::CpuSolver<double> solver(model, GetParam(), ForceMethod::fused);
    for (int s = 0; s < 3; ++s) solver.advance_nodes(kStep);
    ASSERT_GT(model->handle_nodes.size(), 100u);
    for (const HandleNode& held : model->handle_nodes) {
        const glm::dvec3 start(model->positions[held.node]), velocity(model->velocities[held.node]);
        const glm::dvec3 end = start + 3.0 * kStep * velocity;
        EXPECT_LT(glm::distance(glm::dvec3(solver.nodes().positions[held.node]), end), 1e-15 * 16.0);
        EXPECT_EQ(solver.nodes().velocities[held.node], glm::dvec4(model->velocities[held.node]));
    }
}

// In double the two ways differ by the order of summation alone.
TEST_P(AdvanceNodesTest, DivideAndMergeIsTheSameAsFused) {
    const auto model = std::make_shared<const Model>(test::make_lively_model());
    cpu::CpuSolver<double> fused(model, GetParam(), ForceMethod::fused);
    cpu::CpuSolver<double> divided(model, GetParam(), ForceMethod::divide_and_merge);
    for (int s = 0; s < 3; ++s) {
        fused.advance_nodes(kStep);
        divided.advance_nodes(kStep);
    }
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        EXPECT_LT(glm::distance(fused.nodes().positions[n], divided.nodes().positions[n]), 1e-13);
        EXPECT_LT(glm::distance(fused.nodes().velocities[n], divided.nodes().velocities[n]), 1e-10);
    }
}

TEST_P(AdvanceNodesTest, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto model = std::make_shared<const Model>(test::make_lively_model());
    const auto run = [&](std::size_t threads, ForceMethod forces) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        cpu::CpuSolver<float> solver(model, GetParam(), forces);
        for (int s = 0; s < 20; ++s) solver.advance_nodes(kStep);
        return solver.read_state();
    };
    for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
        const State one = run(1, forces), two = run(2, forces);
        const std::size_t bytes = one.positions.size() * sizeof(glm::vec4);
        EXPECT_EQ(std::memcmp(one.positions.data(), two.positions.data(), bytes), 0);
        EXPECT_EQ(std::memcmp(one.velocities.data(), two.velocities.data(), bytes), 0);
    }
}

TEST_P(AdvanceNodesTest, PinnedNodesStayWhereTheyAre) {
    const auto model = std::make_shared<const Model>(test::make_lively_model());
    cpu::CpuSolver<float> solver(model, GetParam(), ForceMethod::fused);
    for (int s = 0; s < 5; ++s) solver.advance_nodes(kStep);
    int pinned = 0;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        if (model->positions[n].w > 0.0f) continue;
        EXPECT_EQ(solver.nodes().positions[n], model->positions[n]);
        ++pinned;
    }
    EXPECT_GT(pinned, 100);
}

// Writing past the last node would corrupt the heap in silence; the guard shows it.
TEST(AdvanceNodes, WritesItsNodesAndNothingElse) {
    const Model model = test::make_lively_model();
    const cpu::Nodes<float> from{model.positions, model.velocities};
    cpu::Nodes<float> to{test::poisoned(model.node_count()), test::poisoned(model.node_count())}, none;
    const auto slices = static_cast<std::uint32_t>(model.half_springs.slice_starts.size() - 1);
    cpu::advance_nodes_simd(cpu::make_pass(model, explicit_scheme(SolverKind::semi_implicit_euler), 0, kStep,
                                           from, from, to, none),
                            {1, slices - 1});
    EXPECT_TRUE(test::guard_is_untouched(to.positions, model.node_count()));
    EXPECT_TRUE(std::isnan(to.positions[63].x)) << "a slice that was not asked for";
    EXPECT_FALSE(std::isnan(to.positions[64].x));
    EXPECT_FALSE(std::isnan(to.positions[model.node_count() - 1].x));
}

// The force is the negative gradient of k/2 (l - rest)^2, found by central differences.
TEST(SpringForce, IsTheGradientOfItsEnergy) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const auto point = [&] { return glm::dvec3(coordinate(random), coordinate(random), coordinate(random)); };
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 a = point(), b = point();
        const double rest = 0.7, stiffness = 40.0, d = 1e-6;
        const auto energy = [&](const glm::dvec3& p) {
            return 0.5 * stiffness * std::pow(glm::distance(p, b) - rest, 2);
        };
        const glm::dvec3 force =
            cpu::spring_force<double>(a, b, glm::dvec3(0), glm::dvec3(0), rest, stiffness, 0.0);
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 step(0.0);
            step[k] = d;
            EXPECT_NEAR(force[k], -(energy(a + step) - energy(a - step)) / (2.0 * d), 1e-6);
        }
    }
}

// k t l' along the spring, nothing across it.
TEST(SpringForce, DampsAlongTheSpringAlone) {
    const glm::dvec3 a(0), b(2, 0, 0);
    const auto force = [&](const glm::dvec3& vb) {
        return cpu::spring_force<double>(a, b, glm::dvec3(0), vb, 2.0, 100.0, 0.03);
    };
    EXPECT_NEAR(force({0.5, 0, 0}).x, 100.0 * 0.03 * 0.5, 1e-12);
    EXPECT_EQ(glm::length(force({0, 0.5, 0.7})), 0.0);
}

TEST(SpringForce, CoincidentEndsGiveZero) {
    const glm::dvec3 a(0.3);
    EXPECT_EQ(cpu::spring_force<double>(a, a, glm::dvec3(0), glm::dvec3(1), 1.0, 100.0, 0.1),
              glm::dvec3(0.0));
}

}  // namespace
}  // namespace gelatin
