// Whole implicit steps on the GPU beside those of the CPU; and that what is left of a step is made before
// anybody reads nodes or changes what acts on them.
#include "gpu/implicit/implicit_solver.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "cpu/implicit/system_solver.h"
#include "gpu/support/body_contact_runs.h"
#include "support/contact_scenes.h"
#include "support/gl_fixture.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

Body soft_block(glm::ivec3 cells, glm::dvec3 place, MaterialModel material = MaterialModel::mass_spring) {
    Body body = test::make_body(test::make_block(cells, 0.1 * glm::dvec3(cells), 0.2));
    for (glm::dvec3& p : body.mesh.positions) p += place;
    body.material.model = material;
    body.material.youngs_modulus = 5e4;
    body.material.damping = 0.01;
    if (material == MaterialModel::neo_hookean) body.material.springs.reset();
    return body;
}

ColliderDescription rough_floor() {
    ColliderDescription description;
    description.shape = PlaneCollider{};
    description.friction = 0.4;
    description.restitution = 0.5;
    return description;
}

using test::kFrame;
using SharedModel = std::shared_ptr<const Model>;

// Lands with a turn on a floor and slides.
SharedModel landing_block() {
    Body body = soft_block({4, 3, 3}, {0.0, 0.02, 0.0});
    body.velocity = {1.0, -2.0, 0.3};
    body.spin = {20.0, 40.0, -60.0};
    return std::make_shared<const Model>(pack_bodies({body}, {rough_floor()}, {0.0, -9.81, 0.0}));
}

// Of either material, in free air: no collider, so no contact.
SharedModel flying_blocks() {
    Body springs = soft_block({3, 3, 2}, {}),
         tets = soft_block({3, 2, 2}, {2.0, 0.0, 0.0}, MaterialModel::neo_hookean);
    springs.spin = {0.0, 200.0, 50.0};
    tets.material.poisson_ratio = 0.4;
    tets.velocity = {0.0, 3.0, 0.0};
    return std::make_shared<const Model>(pack_bodies({springs, tets}, {}, {0.0, -9.81, 0.0}));
}

// Held at one end, pulled by a load and a hand at the other.
SharedModel driven_bar() {
    Body body = soft_block({6, 2, 2}, {0.0, 0.3, 0.0}, MaterialModel::neo_hookean);
    body.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01}};
    body.loads = {{HalfSpaceRegion{{-1.0, 0.0, 0.0}, -0.55}, ForceLoad{{0.0, 2.0, 3.0}}}};
    return std::make_shared<const Model>(pack_bodies({body}, {rough_floor()}, {0.0, -9.81, 0.0}));
}

// The second one hits the first, which lands: the paper's response changes their nodes after each step.
SharedModel colliding_blocks() {
    Body lower = soft_block({4, 3, 3}, {0.0, 0.02, 0.0}), upper = soft_block({3, 3, 2}, {0.05, 0.33, 0.02});
    lower.velocity = {1.0, -2.0, 0.3};
    upper.velocity = {0.0, -4.0, 0.0};
    return std::make_shared<const Model>(pack_bodies({lower, upper}, {rough_floor()}, {0.0, -9.81, 0.0}));
}

// On a box, whose surface moves as a belt does.
SharedModel block_on_a_table() {
    Body body = soft_block({3, 3, 3}, {0.0, 0.11, 0.0});
    body.velocity = {0.3, -1.0, 0.0};
    ColliderDescription table;
    table.shape = Shape(BoxShape{{1.0, 0.2, 1.0}});
    table.friction = 0.4;
    table.surface_velocity = {0.0, 0.0, 0.5};
    return std::make_shared<const Model>(pack_bodies({body}, {table}, {0.0, -9.81, 0.0}));
}

std::vector<Pull> hand_at_the_end(const Model& model) {
    Pull hand;
    hand.target = {0.7, 0.5, 0.2};
    hand.damping_time = 0.02;
    for (std::uint32_t n = 0; n < model.node_count(); ++n)
        if (model.positions[n].x > 0.55f) hand.nodes.push_back({n, glm::vec3(0.0f), 40.0f});
    return {hand};
}

struct StepRun {
    const char* name;
    SharedModel model;
    bool divides, is_pulled;
    int steps;
    CollisionResponse response = CollisionResponse::restore;
};

void PrintTo(const StepRun& run, std::ostream* out) {
    *out << run.name;
}

template <class SolverType>
State state_after(const StepRun& run) {
    SolverType solver(run.model, {.response = run.response}, {.divides_steps = run.divides});
    if (run.is_pulled) solver.set_pulls(hand_at_the_end(*run.model));
    for (int s = 0; s < run.steps; ++s) test::advance(solver, *run.model, s);
    return solver.read_state();
}

double farthest(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
    double most = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        const double distance = glm::distance(glm::dvec3(a[n]), glm::dvec3(b[n]));
        most = std::isfinite(distance) ? std::max(most, distance) : std::numeric_limits<double>::infinity();
    }
    return most;
}

class ImplicitSolverOnGpuTest : public test::GlTest {};
class ImplicitRunOnGpuTest : public test::GlTest, public ::testing::WithParamInterface<StepRun> {};

INSTANTIATE_TEST_SUITE_P(
    Runs, ImplicitRunOnGpuTest,
    ::testing::Values(StepRun{"landing", landing_block(), true, false, 30},
                      StepRun{"landing_in_whole_steps", landing_block(), false, false, 30},
                      StepRun{"flying", flying_blocks(), true, false, 20},
                      StepRun{"driven", driven_bar(), true, true, 20},
                      StepRun{"colliding", colliding_blocks(), true, false, 3},
                      StepRun{"meeting", colliding_blocks(), true, false, 12, CollisionResponse::contact},
                      StepRun{"landing_on_a_table", block_on_a_table(), true, false, 12,
                              CollisionResponse::contact},
                      StepRun{"pushing", test::pushed_block(), true, false, 20, CollisionResponse::contact}),
    [](const auto& test) { return test.param.name; });

// In single precision both differ from the double run by rounding, which impacts enlarge.
TEST_P(ImplicitRunOnGpuTest, DoesWhatTheCpuDoes) {
    const StepRun& run = GetParam();
    const State exact = state_after<cpu::SystemSolver<double>>(run),
                on_cpu = state_after<cpu::SystemSolver<float>>(run),
                on_gpu = state_after<gpu::ImplicitSolver>(run);
    const double rounding = farthest(on_cpu.positions, exact.positions),
                 error = farthest(on_gpu.positions, exact.positions);
    RecordProperty("rounding_and_error", fmt::format("{:.2e} {:.2e}", rounding, error));
    EXPECT_GT(farthest(exact.positions, run.model->positions), 0.02);
    EXPECT_LT(error, 1e-5 + 10.0 * rounding);
}

// More parts are made of the first step on a floor than tries are launched for it.
TEST_F(ImplicitSolverOnGpuTest, ReadingAStepChangesNothing) {
    const SharedModel model = landing_block();
    const auto run = [&](bool reads) {
        gpu::ImplicitSolver solver(model, {}, {.divides_steps = true});
        for (int s = 0; s < 8; ++s) {
            solver.advance({kFrame});
            if (reads) solver.read_state();
        }
        return solver.read_state();
    };
    const State read = run(true), unread = run(false);
    EXPECT_EQ(read.positions, unread.positions);
    EXPECT_EQ(read.velocities, unread.velocities);
}

// What acts from now on does not act in what is left of the step before.
TEST_F(ImplicitSolverOnGpuTest, WhatActsChangesBehindTheStep) {
    const SharedModel model = landing_block();
    const std::vector<glm::vec3> forces(model->node_count(), glm::vec3(0.0f, 0.5f, 0.0f));
    const std::function<void(Solver&)> changes[] = {
        [&](Solver& solver) { solver.set_pulls(hand_at_the_end(*driven_bar())); },
        [&](Solver& solver) { solver.set_forces(forces); },
        [&](Solver& solver) {
            solver.move_pull(0, {0.0, 3.0, 0.0});
        }};
    for (const auto& change : changes) {
        const auto run = [&](bool reads) {
            gpu::ImplicitSolver solver(model, {}, ImplicitSettings{.divides_steps = true});
            Pull hand;
            hand.target = {0.0, 1.0, 0.0};
            hand.nodes = {{0, glm::vec3(0.0f), 50.0f}};
            solver.set_pulls({hand});
            for (int s = 0; s < 4; ++s) {
                solver.advance({kFrame});
                if (reads) solver.read_state();
                if (s == 0) change(solver);
            }
            return solver.read_state();
        };
        EXPECT_EQ(run(true).positions, run(false).positions);
    }
}

TEST_F(ImplicitSolverOnGpuTest, RepeatsBitForBit) {
    const StepRun run{"", landing_block(), true, false, 12};
    const State one = state_after<gpu::ImplicitSolver>(run), two = state_after<gpu::ImplicitSolver>(run);
    EXPECT_EQ(one.positions, two.positions);
    EXPECT_EQ(one.velocities, two.velocities);
}

}  // namespace
}  // namespace gelatin
