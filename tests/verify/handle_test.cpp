// Handles carry their nodes, on every solver: where keyframes say, and off they go when they are released.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cpu/make_solver.h"
#include "gpu/make_solver.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin::handle_test {
namespace {

// Takes the place of the simulator: steps from the start on, `count` of them.
void advance(Solver& solver, const Model& model, double step, int count, int first = 0) {
    for (int s = first; s < first + count; ++s) {
        solver.advance({step, handle_motions(model.handles, s * step, step)});
    }
}

Body soft_bar() {
    Material material = test::structural_material();
    material.youngs_modulus = 1e4;
    material.damping = 2e-3;
    return test::make_body(test::make_block({6, 2, 2}, {0.6, 0.2, 0.2}, 0.2), material);
}

// A bar whose left end turns, moves and grows, whatever the step.
Model carried_bar() {
    Body bar = soft_bar();
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    handle.interpolation = Interpolation::smooth;
    handle.keyframes = {
        {0.0}, {0.1, {0.05, 0.1, 0.0}, {90.0, 0.0, 30.0}, 1.2}, {0.15, {}, {400.0, 0.0, 0.0}}};
    bar.handles = {handle};
    return test::make_model(bar, {0.0, -9.81, 0.0});
}

// Largest distance of a held node from where its handle is at `time`.
double largest_lag(const Model& model, const std::vector<glm::vec4>& positions, double time) {
    double largest = 0.0;
    for (const HandleNode& held : model.handle_nodes) {
        const HandlePose pose = pose_at(model.handles[held.handle], time);
        const glm::dvec3 place = pose.center + pose.map * glm::dvec3(held.arm);
        largest = std::max(largest, glm::distance(place, glm::dvec3(positions[held.node])));
    }
    return largest;
}

TEST(Handle, CarriesItsNodesAtAnyStep) {
    const auto model = std::make_shared<const Model>(carried_bar());
    for (const SolverKind kind : test::kSolvers) {
        const double most = std::min(0.01, 0.5 * largest_stable_step(kind, *model));
        for (const double fraction : {1.0, 0.37}) {
            const int count = static_cast<int>(std::ceil(0.2 / (fraction * most)));
            const double step = 0.2 / count;
            if (count > 20'000) continue;  // explicit Euler's
            const auto solver = cpu::make_solver<float>(model, kind);
            for (int s = 0; s < count; s += 5) {
                const int steps = std::min(5, count - s);
                advance(*solver, *model, step, steps, s);
                EXPECT_LT(largest_lag(*model, solver->read_state().positions, (s + steps) * step), 1e-6)
                    << name_of(kind) << " of " << step << " s, step " << s;
            }
        }
    }
}

class HandleOnGpuTest : public test::GlTest {};

TEST_F(HandleOnGpuTest, CarriesItsNodesAtAnyStep) {
    const auto model = std::make_shared<const Model>(carried_bar());
    for (const SolverKind kind : {SolverKind::semi_implicit_euler, SolverKind::rk4, SolverKind::implicit}) {
        const double step = std::min(0.01, 0.5 * largest_stable_step(kind, *model));
        const auto solver = gpu::make_solver(model, kind);
        for (int s = 0; s < 100; s += 10) {
            advance(*solver, *model, step, 10, s);
            EXPECT_LT(largest_lag(*model, solver->read_state().positions, (s + 10) * step), 1e-6)
                << name_of(kind);
        }
    }
}

struct Motion {
    glm::dvec3 momentum{0.0}, angular_momentum{0.0};  // about the origin
};

Motion motion_of(const Model& model, const State& state) {
    Motion motion;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::dvec3 p = static_cast<double>(model.masses[n]) * glm::dvec3(state.velocities[n]);
        motion.momentum += p;
        motion.angular_momentum += glm::cross(glm::dvec3(state.positions[n]), p);
    }
    return motion;
}

// Once it lets go, the body flies on with the momentum and the angular momentum of that moment.
TEST(Handle, ReleasedBodiesKeepTheirMomentum) {
    Body bar = soft_bar();
    HandleDescription handle;
    handle.region = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    handle.keyframes = {{0.0}, {1.0, {0.4, 0.2, 0.0}, {0.0, 0.0, 90.0}}};
    handle.release = 0.2;
    bar.handles = {handle};
    const auto model = std::make_shared<const Model>(test::make_model(bar));
    for (const SolverKind kind : test::kSolvers) {
        if (kind == SolverKind::explicit_euler) continue;  // amplifies what it is given
        const double most = std::min(0.005, 0.5 * largest_stable_step(kind, *model));
        const int count = static_cast<int>(std::ceil(0.2 / most));
        const auto solver = cpu::make_solver<double>(model, kind);
        advance(*solver, *model, 0.2 / count, count);
        const Motion before = motion_of(*model, solver->read_state());
        advance(*solver, *model, 0.2 / count, count, count);
        const Motion after = motion_of(*model, solver->read_state());
        for (const HandleNode& held : model->handle_nodes)
            EXPECT_EQ(solver->read_state().positions[held.node].w, held.arm.w);
        const double size = model->objects[0].mass * 0.4;  // at 0.4 m/s
        EXPECT_GT(glm::length(before.momentum), 0.5 * size);
        EXPECT_LT(glm::distance(after.momentum, before.momentum), 1e-6 * size) << name_of(kind);
        // Implicit Euler damps turning, by some per cent over such steps.
        const double share = kind == SolverKind::implicit ? 0.1 : 0.005;
        EXPECT_LT(glm::distance(after.angular_momentum, before.angular_momentum), share * size)
            << name_of(kind);
    }
}

// A spin is an angular velocity about the centre of mass: the velocity of the centre is the body's, and the
// angular momentum about it is I w.
TEST(Spin, GivesTheAngularMomentumOfARigidBody) {
    Body block = test::make_body(test::make_block({4, 3, 5}, {0.4, 0.6, 0.2}, 0.2));
    block.velocity = {1.0, -2.0, 0.5};
    block.spin = glm::radians(glm::dvec3(100.0, 400.0, -250.0));
    const Model model = test::make_model(block);
    glm::dvec3 center(0.0), momentum(0.0), angular(0.0);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const auto mass = static_cast<double>(model.masses[n]);
        center += mass / model.objects[0].mass * glm::dvec3(model.positions[n]);
        momentum += mass * glm::dvec3(model.velocities[n]);
    }
    glm::dmat3 inertia(0.0);
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const glm::dvec3 r = glm::dvec3(model.positions[n]) - center;
        const auto mass = static_cast<double>(model.masses[n]);
        angular += mass * glm::cross(r, glm::dvec3(model.velocities[n]));
        inertia += mass * (glm::dot(r, r) * glm::dmat3(1.0) - glm::outerProduct(r, r));
    }
    EXPECT_LT(glm::distance(momentum / model.objects[0].mass, block.velocity), 1e-6);
    const glm::dvec3 expected = inertia * block.spin;
    EXPECT_LT(glm::distance(angular, expected), 1e-6 * glm::length(expected));
    // As a solid of 0.4 x 0.6 x 0.2 m has it, but for the lumping of masses.
    EXPECT_NEAR(inertia[1][1] / (48.0 * (0.16 + 0.04) / 12.0), 1.0, 0.15);
}

}  // namespace
}  // namespace gelatin::handle_test
