// Bodies without contact: flight, momentum, energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/explicit/explicit_solver.h"
#include "gpu/explicit/explicit_solver.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin::free_motion_test {
namespace {

Model thrown_block() {
    Body body = test::make_body(test::make_block({3, 4, 3}, {0.3, 0.4, 0.3}, 0.2));
    body.velocity = {1.0, 4.0, -2.0};
    return test::make_model(body, {0.0, -9.81, 0.0});
}

ObjectMeasure measure(Solver& solver) {
    solver.begin_measure();
    return solver.end_measure().objects[0];
}

// y(t) = y0 + v t - g t^2 / 2. Forward Euler lags by g t h / 2, the semi-implicit rule leads by as much; the
// midpoint rule and RK4 are exact for a parabola.
TEST(FreeFlight, IsExactToTheSchemesOrder) {
    const auto model = std::make_shared<const Model>(thrown_block());
    const double step = 1e-3, time = 0.5;
    const double g = -static_cast<double>(model->gravity.y);
    const double v = static_cast<double>(model->velocities[0].y);
    const std::pair<SolverKind, double> cases[] = {{SolverKind::explicit_euler, 0.5 * g * time * step},
                                                   {SolverKind::semi_implicit_euler, -0.5 * g * time * step},
                                                   {SolverKind::midpoint, 0.0},
                                                   {SolverKind::rk4, 0.0}};
    for (const auto& [kind, lead] : cases) {
        cpu::ExplicitSolver<double> solver(model, kind, ForceMethod::fused);
        for (int s = 0; s < 500; ++s) solver.advance({step});
        const double expected =
            static_cast<double>(model->positions[7].y) + v * time - 0.5 * g * time * time + lead;
        // Rest lengths are rounded to float, so the body is strained by 1e-7 and trembles by that much, more
        // and more with explicit Euler; the lead is 2.5 mm.
        EXPECT_NEAR(solver.nodes().positions[7].y, expected, 5e-6) << name_of(kind);
    }
}

// Internal forces come in opposite pairs: in double, momentum keeps to rounding while the body shakes. Each
// of n nodes adds an error of eps times its force impulse a step.
TEST(Momentum, OfAFreeObjectIsKept) {
    Model model = thrown_block();
    model.gravity = glm::vec3(0.0f);
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        model.velocities[n].z += (n % 3 == 0) ? 2.0f : -1.0f;
    for (const ForceMethod forces : {ForceMethod::fused, ForceMethod::divide_and_merge}) {
        cpu::ExplicitSolver<double> oracle(std::make_shared<const Model>(model),
                                           SolverKind::semi_implicit_euler, forces);
        cpu::ExplicitSolver<float> product(std::make_shared<const Model>(model),
                                           SolverKind::semi_implicit_euler, forces);
        const glm::dvec3 start = measure(oracle).momentum;
        const double size = model.objects[0].mass * 5.0;  // mass times a typical speed
        const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, model);
        for (int s = 0; s < 2000; ++s) {
            oracle.advance({step});
            product.advance({step});
        }
        EXPECT_LT(glm::distance(measure(oracle).momentum, start) / size, 1e-12);
        EXPECT_LT(glm::distance(measure(product).momentum, start) / size, 1e-5);
    }
}

class MomentumOnGpuTest : public test::GlTest {};
TEST_F(MomentumOnGpuTest, OfAFreeObjectIsKept) {
    Model model = thrown_block();
    model.gravity = glm::vec3(0.0f);
    for (std::size_t n = 0; n < model.velocities.size(); ++n)
        model.velocities[n].z += (n % 3 == 0) ? 2.0f : -1.0f;
    gpu::ExplicitSolver solver(std::make_shared<const Model>(model), SolverKind::semi_implicit_euler,
                               ForceMethod::fused);
    const glm::dvec3 start = measure(solver).momentum;
    const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, model);
    for (int s = 0; s < 500; ++s) solver.advance({step});
    EXPECT_LT(glm::distance(measure(solver).momentum, start) / (model.objects[0].mass * 5.0), 1e-5);
}

// Semi-implicit Euler conserves a modified energy: over 10,000 steps the true one stays within a band that
// does not drift, where explicit Euler's grows without limit.
TEST(Energy, OfSemiImplicitEulerIsBoundedOver10000Steps) {
    Model model = test::make_model(test::make_body(test::make_block({3, 3, 3}, {0.3, 0.3, 0.3}, 0.2)));
    for (glm::vec4& p : model.positions) p.x *= 1.05f;
    cpu::ExplicitSolver<double> solver(std::make_shared<const Model>(model), SolverKind::semi_implicit_euler,
                                       ForceMethod::fused);
    const double step = 0.5 * largest_stable_step(SolverKind::semi_implicit_euler, model);
    const auto energy = [&] {
        const ObjectMeasure sums = measure(solver);
        return sums.kinetic_energy + sums.elastic_energy;
    };
    const double start = energy();
    double early = 0.0, late = 0.0;
    for (int s = 1; s <= 10'000; ++s) {
        solver.advance({step});
        const double deviation = std::abs(energy() / start - 1.0);
        if (s <= 1000) early = std::max(early, deviation);
        if (s > 9000) late = std::max(late, deviation);
    }
    EXPECT_LT(early, 0.25);
    EXPECT_LT(late, 0.25);
    EXPECT_LT(late, 1.5 * early) << "it drifts";
}

}  // namespace
}  // namespace gelatin::free_motion_test
