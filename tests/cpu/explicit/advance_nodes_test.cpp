#include "cpu/explicit/advance_nodes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <random>

#include "cpu/explicit/explicit_solver.h"
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

// SIMD against the double reference: wrong lanes, tails or transposes would be off by far more than rounding.
TEST_P(AdvanceNodesTest, FloatWithSimdMatchesTheOracle) {
    for (const Model& model : {test::make_lively_model(), test::make_driven_model()}) {
        ASSERT_NE(model.node_count() % 64, 0u);
        EXPECT_LE(test::worst_simd_error(model, GetParam(), kStep), 1.0);
    }
}

// A node without inverse mass moves with its velocity, straight, whatever pulls and presses.
TEST_P(AdvanceNodesTest, HeldNodesMoveWithTheirVelocity) {
    const auto model = std::make_shared<const Model>(test::make_driven_model());
    cpu::ExplicitSolver<double> solver(model, GetParam(), ForceMethod::fused);
    for (int s = 0; s < 3; ++s) solver.advance({kStep});
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
    cpu::ExplicitSolver<double> fused(model, GetParam(), ForceMethod::fused);
    cpu::ExplicitSolver<double> divided(model, GetParam(), ForceMethod::divide_and_merge);
    for (int s = 0; s < 3; ++s) {
        fused.advance({kStep});
        divided.advance({kStep});
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
        cpu::ExplicitSolver<float> solver(model, GetParam(), forces);
        for (int s = 0; s < 20; ++s) solver.advance({kStep});
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
    cpu::ExplicitSolver<float> solver(model, GetParam(), ForceMethod::fused);
    for (int s = 0; s < 5; ++s) solver.advance({kStep});
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
                            cpu::make_pass_tets(model), {1, slices - 1});
    EXPECT_TRUE(test::guard_is_untouched(to.positions, model.node_count()));
    EXPECT_TRUE(std::isnan(to.positions[63].x)) << "a slice that was not asked for";
    EXPECT_FALSE(std::isnan(to.positions[64].x));
    EXPECT_FALSE(std::isnan(to.positions[model.node_count() - 1].x));
}

}  // namespace
}  // namespace gelatin
