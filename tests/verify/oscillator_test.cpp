// Two nodes of mass m on a spring k swing about their centre with w = sqrt(k / mu), mu = m / 2 the reduced
// mass: x(t) = rest_length + A cos(w t). docs/physics.md, "Integration".
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cpu/explicit/explicit_solver.h"
#include "gpu/explicit/explicit_solver.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin::oscillator_test {
namespace {

constexpr double kStiffness = 50.0;  // [N/m], so that w = 10 rad/s
constexpr double kFrequency = 10.0;
constexpr double kAmplitude = 0.1;  // [m]

Model oscillator() {
    return test::make_model(test::make_oscillator(kStiffness, 1.0, kAmplitude));
}

double stretch_of(const Model& model, const auto& positions) {
    return static_cast<double>(positions[1].x) - static_cast<double>(positions[0].x) -
           static_cast<double>(model.springs[0].rest_length);
}

double start_amplitude(const Model& model) {
    return stretch_of(model, model.positions);
}

// Error at t = 0.5 s, five radians on, with `steps` steps.
double error_after(SolverKind solver, int steps) {
    const auto model = std::make_shared<const Model>(oscillator());
    cpu::ExplicitSolver<double> oracle(model, solver, ForceMethod::fused);
    const double time = 0.5;
    for (int s = 0; s < steps; ++s) oracle.advance({time / steps});
    return std::abs(stretch_of(*model, oracle.nodes().positions) -
                    start_amplitude(*model) * std::cos(kFrequency * time));
}

struct Order {
    SolverKind solver;
    int order;
};
class ConvergenceTest : public ::testing::TestWithParam<Order> {};
INSTANTIATE_TEST_SUITE_P(Solvers, ConvergenceTest,
                         ::testing::Values(Order{SolverKind::explicit_euler, 1},
                                           Order{SolverKind::semi_implicit_euler, 1},
                                           Order{SolverKind::midpoint, 2}, Order{SolverKind::rk4, 4}),
                         [](const auto& test) { return name_of(test.param.solver); });

// Halving the step divides the error by 2^order.
TEST_P(ConvergenceTest, HasTheOrderOfItsScheme) {
    for (const int steps : {400, 800}) {
        const double ratio =
            error_after(GetParam().solver, steps) / error_after(GetParam().solver, 2 * steps);
        EXPECT_NEAR(std::log2(ratio), GetParam().order, 0.1) << steps << " steps";
    }
}

// Time between upward zero crossings, by linear interpolation within a step.
double measured_period(const Model& model, Solver& solver, double step, int periods) {
    std::vector<double> crossings;
    double before = start_amplitude(model);
    for (int s = 1; crossings.size() <= static_cast<std::size_t>(periods); ++s) {
        solver.advance({step});
        const double now = stretch_of(model, solver.read_state().positions);
        if (before < 0.0 && now >= 0.0) crossings.push_back((s - 1 + before / (before - now)) * step);
        before = now;
        if (s > 100'000) break;
    }
    return (crossings.back() - crossings.front()) / (static_cast<double>(crossings.size()) - 1.0);
}

// Semi-implicit Euler swings at sin(w' h / 2) = w h / 2, RK4 at w to fourth order.
TEST(OscillatorTest, PeriodOnTheCpu) {
    const auto model = std::make_shared<const Model>(oscillator());
    const double step = 2e-3, exact = 2.0 * std::numbers::pi / kFrequency;
    cpu::ExplicitSolver<float> rk4(model, SolverKind::rk4, ForceMethod::fused);
    EXPECT_NEAR(measured_period(*model, rk4, step, 5) / exact, 1.0, 1e-5);
    cpu::ExplicitSolver<float> euler(model, SolverKind::semi_implicit_euler, ForceMethod::fused);
    const double discrete = 2.0 * std::numbers::pi / (2.0 / step * std::asin(0.5 * kFrequency * step));
    EXPECT_NEAR(measured_period(*model, euler, step, 5) / discrete, 1.0, 1e-5);
}

class OscillatorOnGpuTest : public test::GlTest {};
TEST_F(OscillatorOnGpuTest, Period) {
    const auto model = std::make_shared<const Model>(oscillator());
    for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
        gpu::ExplicitSolver solver(model, SolverKind::rk4, forces);
        EXPECT_NEAR(measured_period(*model, solver, 5e-3, 2) / (2.0 * std::numbers::pi / kFrequency), 1.0,
                    1e-4);
    }
}

// x'' = -(k / mu) (x + t x'): amplitude falls by exp(-t w^2 / 2 per second).
TEST(OscillatorTest, DampingDecaysAtItsRate) {
    test::Net net = test::make_oscillator(kStiffness, 1.0, kAmplitude);
    net.damping_time = 0.01;
    const auto model = std::make_shared<const Model>(test::make_model(net));
    cpu::ExplicitSolver<double> solver(model, SolverKind::rk4, ForceMethod::fused);
    const double decay = 0.5 * net.damping_time * kFrequency * kFrequency;  // [1/s]
    const double w = std::sqrt(kFrequency * kFrequency - decay * decay);
    const double time = 4.0 * std::numbers::pi / w;  // two periods
    for (int s = 0; s < 4000; ++s) solver.advance({time / 4000});
    EXPECT_NEAR(stretch_of(*model, solver.nodes().positions) / start_amplitude(*model),
                std::exp(-decay * time), 1e-5);
}

}  // namespace
}  // namespace gelatin::oscillator_test
