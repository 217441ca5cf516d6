#include "model/explicit/stability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cpu/explicit/explicit_solver.h"
#include "gelatin/error.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// Two equal masses on a spring: omega^2 = 2 k / m, and the bound is exact.
TEST(FrequencyBound, IsExactForTwoNodes) {
    const Model model = test::make_model(test::make_oscillator(50.0, 1.0, 0.0));
    EXPECT_NEAR(frequency_bound(model, model.objects[0]), 10.0, 1e-6);
}

// What a handle will release counts as free, what it holds for good as pinned.
TEST(FrequencyBound, LooksBeyondTheRelease) {
    Body block = test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2));
    const Region most = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.25};
    const auto bound = [](const Body& body) {
        const Model model = test::make_model(body);
        return frequency_bound(model, model.objects[0]);
    };
    const double free = bound(block);
    block.pins = {most};
    const double pinned = bound(block);
    ASSERT_LT(pinned, 0.999 * free);
    block.pins.clear();
    HandleDescription handle;
    handle.region = most;
    block.handles = {handle};
    EXPECT_DOUBLE_EQ(bound(block), pinned);
    block.handles[0].release = 1.0;
    EXPECT_DOUBLE_EQ(bound(block), free);
}

// Three springs at right angles: they can all be rotated into one direction.
TEST(FrequencyBound, OfAnyShapeAddsUpAllSprings) {
    test::Net net;
    net.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    net.velocities.resize(4);
    const double pinned = std::numeric_limits<double>::infinity();
    net.masses = {2.0, pinned, pinned, pinned};
    net.springs = {{0, 1, 1.0f, 50.0f}, {0, 2, 1.0f, 50.0f}, {0, 3, 1.0f, 50.0f}};
    const Model model = test::make_model(net);
    EXPECT_NEAR(frequency_bound(model, model.objects[0]), 5.0, 1e-6);
    EXPECT_NEAR(frequency_bound(model, model.objects[0], Deformation::any), 5.0 * std::sqrt(3.0), 1e-6);
}

TEST(LargestStableStep, MatchesTheTextbooksWithoutDamping) {
    EXPECT_NEAR(largest_stable_step(SolverKind::semi_implicit_euler, 100.0, 0.0), 2.0 / 100.0, 1e-4);
    EXPECT_NEAR(largest_stable_step(SolverKind::rk4, 100.0, 0.0), 2.0 * std::sqrt(2.0) / 100.0, 1e-3);
    // Growth per second of explicit Euler: h w^2 / 2; of the midpoint rule: h^3 w^4 / 8. Both are to be 1%.
    EXPECT_NEAR(largest_stable_step(SolverKind::explicit_euler, 100.0, 0.0), 0.02 / 1e4, 1e-8);
    EXPECT_NEAR(largest_stable_step(SolverKind::midpoint, 100.0, 0.0), std::cbrt(0.08 / 1e8), 1e-5);
}

// a + 2 d < 4 with a = h^2 w^2, d = h t w^2: h = (2 / w) (sqrt(1 + z^2) - z), z = t w / 2.
TEST(LargestStableStep, MatchesTheClosedFormWithDamping) {
    for (const double damping : {1e-4, 1e-3, 1e-2, 1e-1}) {
        const double w = 300.0, z = 0.5 * damping * w;
        EXPECT_NEAR(largest_stable_step(SolverKind::semi_implicit_euler, w, damping) /
                        (2.0 / w * (std::sqrt(1.0 + z * z) - z)),
                    1.0, 1e-3);
    }
    // Explicit Euler is held by its damping: h <= t for modes that still oscillate.
    EXPECT_NEAR(largest_stable_step(SolverKind::explicit_euler, 100.0, 1e-3), 1e-3, 2e-5);
}

constexpr SolverKind kSemiImplicit = SolverKind::semi_implicit_euler;

double energy_after(const Model& model, SolverKind kind, double step, int steps) {
    cpu::ExplicitSolver<double> solver(std::make_shared<const Model>(model), kind, ForceMethod::fused);
    for (int s = 0; s < steps; ++s) solver.advance({step});
    solver.begin_measure();
    const ObjectMeasure sums = solver.end_measure().objects[0];
    return sums.kinetic_energy + sums.elastic_energy;
}

// The bound is safe on a real net and not needlessly small: with it the energy stays, at 1.35 times the step
// it grows without limit.
TEST(LargestStableStep, SeparatesQuietFromExploding) {
    Model model = test::make_model(test::make_body(test::make_block({6, 5, 4}, {1.2, 1.0, 0.8}, 0.3)));
    for (std::size_t n = 0; n < model.velocities.size(); ++n) {
        model.velocities[n].x = 1e-3f * static_cast<float>(n % 7) - 3e-3f;
    }
    const double step = largest_stable_step(kSemiImplicit, model);
    const double start = energy_after(model, kSemiImplicit, step, 0);
    EXPECT_LT(energy_after(model, kSemiImplicit, step, 2000), 2.0 * start);
    EXPECT_FALSE(energy_after(model, kSemiImplicit, 1.35 * step, 2000) < 100.0 * start) << "or NaN by then";
}

// Of fitted springs.
Model quivering_block(double poisson_ratio, double damping) {
    Material material;
    material.poisson_ratio = poisson_ratio;
    material.damping = damping;
    Model model =
        test::make_model(test::make_body(test::make_block({5, 4, 3}, {1.0, 0.8, 0.6}, 0.2), material));
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        model.velocities[n].x = 1e-3f * static_cast<float>(n % 7) - 3e-3f;
    return model;
}

// The volume term makes bodies stiffer, and the bound still is neither unsafe nor needlessly small.
TEST(LargestStableStepHeavy, KnowsTheVolumeTerm) {
    for (const double poisson_ratio : {0.1, 0.4, 0.49}) {
        const Model model = quivering_block(poisson_ratio, 0.0);
        const double step = largest_stable_step(kSemiImplicit, model);
        const double start = energy_after(model, kSemiImplicit, step, 0);
        EXPECT_LT(energy_after(model, kSemiImplicit, step, 1000), 4.0 * start) << poisson_ratio;
        EXPECT_FALSE(energy_after(model, kSemiImplicit, 2.0 * step, 1000) < 100.0 * start) << poisson_ratio;
    }
}

// It is not damped: what holds explicit Euler is the share of springs.
TEST(LargestStableStep, KnowsThatVolumesAreNotDamped) {
    const Model model = quivering_block(0.45, 1e-3);
    const double step = largest_stable_step(SolverKind::explicit_euler, model);
    const double start = energy_after(model, SolverKind::explicit_euler, step, 0);
    EXPECT_LT(energy_after(model, SolverKind::explicit_euler, step, 1000), start);
    EXPECT_GT(largest_stable_step(SolverKind::explicit_euler, quivering_block(0.25, 1e-3)), 2.0 * step);
}

Scene scene_with(SolverKind solver, std::optional<int> substeps) {
    Scene scene;
    scene.file = "a.toml";
    scene.simulation.solver = solver;
    scene.simulation.frame_rate = 50.0;
    scene.simulation.substeps = substeps;
    return scene;
}

// w = 1000 rad/s: the largest step is 2 ms, of which `auto` uses 1.6: 12.5 steps in 20 ms.
TEST(ChooseSubsteps, TakesTheFewestThatAreSafe) {
    const Model model = test::make_model(test::make_oscillator(5e5, 1.0, 0.0));
    EXPECT_EQ(choose_substeps(scene_with(SolverKind::semi_implicit_euler, std::nullopt), model), 13);
    EXPECT_EQ(choose_substeps(scene_with(SolverKind::semi_implicit_euler, 11), model), 11);
}

TEST(ChooseSubsteps, NamesTheLargestSafeStepWhereAFixedOneIsTooLong) {
    const Model model = test::make_model(test::make_oscillator(5e5, 1.0, 0.0));
    try {
        choose_substeps(scene_with(SolverKind::semi_implicit_euler, 9), model);
        FAIL() << "accepted a step of 2.2 ms where 2 ms is the limit";
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(
            error.what(),
            "a.toml: simulation.substeps = 9: a step of 0.00222 s is too long; the largest safe step is "
            "0.002 s (substeps = 13, or \"auto\")");
    }
}

TEST(ChooseSubsteps, RefusesWhatWouldNeverEnd) {
    const Model model = test::make_model(test::make_oscillator(5e5, 1.0, 0.0));
    try {
        choose_substeps(scene_with(SolverKind::explicit_euler, std::nullopt), model);
        FAIL() << "accepted undamped explicit Euler";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("explicit_euler amplifies motion that is not damped"));
    }
}

TEST(ChooseSubsteps, OneIsEnoughWithoutSprings) {
    test::Net net = test::make_oscillator(1.0, 1.0, 0.0);
    net.springs.clear();
    EXPECT_EQ(choose_substeps(scene_with(SolverKind::rk4, std::nullopt), test::make_model(net)), 1);
}

}  // namespace
}  // namespace gelatin
