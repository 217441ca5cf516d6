// A hand that holds nodes, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu/explicit/explicit_solver.h"
#include "cpu/implicit/system_solver.h"
#include "cpu/make_solver.h"
#include "gpu/make_solver.h"
#include "model/explicit/stability.h"
#include "model/setting_names.h"
#include "support/gl_fixture.h"
#include "support/solver_kinds.h"
#include "support/test_models.h"

namespace gelatin::pull_test {
namespace {

constexpr double kRate = 20.0;  // of the hand [1/s]
struct Center {
    glm::dvec3 position{0.0}, velocity{0.0};
};
Center center_of(const Model& model, const State& state) {
    Center center;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const double part = static_cast<double>(model.masses[n]) / model.objects[0].mass;
        center.position += part * glm::dvec3(state.positions[n]);
        center.velocity += part * glm::dvec3(state.velocities[n]);
    }
    return center;
}

// All nodes of a body held where they are, as firmly as they are heavy; critically damped.
Pull hold_all(const Model& model) {
    Pull pull;
    for (std::uint32_t n = 0; n < model.node_count(); ++n) {
        const auto stiffness = static_cast<float>(kRate * kRate) * model.masses[n];
        pull.nodes.push_back({n, glm::vec3(model.positions[n]), stiffness});
    }
    pull.damping_time = 2.0 / kRate;
    return pull;
}

std::shared_ptr<const Model> make_block_model(const glm::dvec3& gravity) {
    Material material = test::structural_material();
    material.damping = 1e-3;  // without any, explicit Euler's steps are too short for single precision
    const Body block = test::make_body(test::make_block({4, 3, 3}, {0.4, 0.3, 0.3}, 0.2), material);
    return std::make_shared<const Model>(test::make_model(block, gravity));
}

// The centre moves like a critically damped oscillator, x = d (1 - (1 + w t) exp(-w t)), off by the
// step's first order; let go, it keeps its speed.
template <class MakeSolver>
void expect_critical_damping(const MakeSolver& make_solver) {
    const auto model = make_block_model(glm::dvec3(0.0));
    const glm::dvec3 way(0.3, 0.2, -0.1);
    for (const SolverKind kind : test::kSolvers) {
        const double step = std::min(1e-3, 0.5 * largest_stable_step(kind, *model));
        const std::unique_ptr<Solver> solver = make_solver(model, kind);
        const glm::dvec3 start = center_of(*model, solver->read_state()).position;
        solver->set_pulls({hold_all(*model)});
        solver->move_pull(0, way);
        const int steps = static_cast<int>(1.0 / kRate / step);
        for (int s = 0; s < steps; ++s) solver->advance({step});
        const double phase = kRate * steps * step;
        const Center center = center_of(*model, solver->read_state());
        EXPECT_LT(glm::distance(center.position - start, way * (1.0 - (1.0 + phase) * std::exp(-phase))),
                  (2.0 * kRate * step + 1e-4) * glm::length(way))
            << name_of(kind);

        solver->set_pulls({});
        for (int s = 0; s < 20; ++s) solver->advance({step});
        EXPECT_LT(glm::distance(center_of(*model, solver->read_state()).velocity, center.velocity),
                  1e-3 * glm::length(center.velocity))
            << name_of(kind);
    }
}

TEST(Pull, ABodyFollowsTheHandAndKeepsItsMomentum) {
    expect_critical_damping([](const auto& model, SolverKind kind) {
        return cpu::make_solver<double>(model, kind, ForceMethod::divide_and_merge);
    });
    expect_critical_damping([](const auto& model, SolverKind kind) {
        return cpu::make_solver<float>(model, kind, ForceMethod::fused);
    });
}

class PullOnGpuTest : public test::GlTest {};
TEST_F(PullOnGpuTest, ABodyFollowsTheHandAndKeepsItsMomentum) {
    expect_critical_damping(
        [](const auto& model, SolverKind kind) { return gpu::make_solver(model, kind, ForceMethod::fused); });
}

// A force on each node as its mass has it moves the body as gravity would.
template <class MakeSolver>
void expect_fall(const MakeSolver& make_solver) {
    const auto model = make_block_model(glm::dvec3(0.0));
    const glm::vec3 acceleration(1.0f, -2.0f, 3.0f);
    std::vector<glm::vec3> forces;
    for (const float mass : model->masses) forces.push_back(mass * acceleration);
    for (const SolverKind kind : test::kSolvers) {
        const double step = std::min(1e-3, 0.5 * largest_stable_step(kind, *model));
        const std::unique_ptr<Solver> solver = make_solver(model, kind);
        solver->set_forces(forces);
        const int steps = 50;
        for (int s = 0; s < steps; ++s) solver->advance({step});
        const glm::dvec3 expected = step * steps * glm::dvec3(acceleration);
        const glm::dvec3 velocity = center_of(*model, solver->read_state()).velocity;
        // Velocities of implicit steps are differences of coordinates of half a metre in single precision.
        // The implicit step, which begins by Euler's scheme, has 0.43 of its last step's change still to
        // come.
        const double rounding = 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) / step;
        const double to_come =
            kind == SolverKind::implicit ? 0.43 * step * glm::length(glm::dvec3(acceleration)) : 0.0;
        const double bound = 1e-3 * glm::length(expected) + rounding + to_come;
        EXPECT_LT(glm::distance(velocity, expected), bound) << name_of(kind);
        solver->set_forces({});
        for (int s = 0; s < steps; ++s) solver->advance({step});
        EXPECT_LT(glm::distance(center_of(*model, solver->read_state()).velocity, velocity), bound)
            << name_of(kind);
    }
}

TEST(Pull, ForcesAccelerateUntilTheyEnd) {
    expect_fall([](const auto& model, SolverKind kind) {
        return cpu::make_solver<double>(model, kind, ForceMethod::divide_and_merge);
    });
    expect_fall([](const auto& model, SolverKind kind) {
        return cpu::make_solver<float>(model, kind, ForceMethod::fused);
    });
}

TEST_F(PullOnGpuTest, ForcesAccelerateUntilTheyEnd) {
    expect_fall(
        [](const auto& model, SolverKind kind) { return gpu::make_solver(model, kind, ForceMethod::fused); });
}

// A few nodes at one end carry the whole body, at the step of a picture: their springs are a thousand times
// what those nodes' masses would bear in an explicit scheme. At rest they give way by its weight.
TEST(Pull, AFewNodesCarryTheBodyInLongSteps) {
    const glm::dvec3 gravity(0.0, -9.81, 0.0);
    Material material = test::structural_material();
    material.youngs_modulus = 1e6;
    material.damping = 0.02;
    const Body block = test::make_body(test::make_block({4, 3, 3}, {0.4, 0.3, 0.3}, 0.2), material);
    const auto model = std::make_shared<const Model>(test::make_model(block, gravity));
    Pull pull;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        if (model->positions[n].y > 0.29f) pull.nodes.push_back({n, glm::vec3(model->positions[n]), 0.0f});
    }
    const double stiffness = model->objects[0].mass * kRate * kRate;
    for (Pull::Node& held : pull.nodes)
        held.stiffness = static_cast<float>(stiffness / static_cast<double>(pull.nodes.size()));
    pull.damping_time = 2.0 / kRate;
    cpu::SystemSolver<float> solver(model, {}, {40});
    solver.set_pulls({pull});
    for (int s = 0; s < 240; ++s) solver.advance({1.0 / 60.0});
    const State state = solver.read_state();
    glm::dvec3 force(0.0);
    for (const Pull::Node& held : pull.nodes)
        force += static_cast<double>(held.stiffness) *
                 glm::dvec3(held.arm - glm::vec3(state.positions[held.node]));
    EXPECT_LT(glm::distance(force, -model->objects[0].mass * gravity), 0.02 * model->objects[0].mass * 9.81);
    EXPECT_LT(glm::length(center_of(*model, state).velocity), 1e-2);
}

// However strong the hand, light nodes in explicit schemes stay where it leads them.
TEST(Pull, AStrongHandIsStableInExplicitSchemes) {
    const auto model = make_block_model(glm::dvec3(0.0));
    for (const SolverKind kind : {SolverKind::semi_implicit_euler, SolverKind::rk4}) {
        const double step = 0.8 * largest_stable_step(kind, *model);
        Pull pull;
        for (std::uint32_t n = 0; n < 3; ++n)
            pull.nodes.push_back({n, glm::vec3(model->positions[n]), 1e7f * model->masses[n]});
        pull.damping_time = 0.01;
        pull.target = {0.02, 0.0, 0.0};
        cpu::ExplicitSolver<float> solver(model, kind, ForceMethod::fused);
        solver.set_pulls({pull});
        for (int s = 0; s < 2000; ++s) solver.advance({step});
        for (const glm::vec4& p : solver.read_state().positions) ASSERT_LT(glm::length(glm::vec3(p)), 1.0f);
    }
}

}  // namespace
}  // namespace gelatin::pull_test
