// What pins and handles exert on the device beside what they do on the CPU: with hands and contacts, in
// motion and where bodies are in their way.
#include "gpu/implicit/held_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "cpu/implicit/system_solver.h"
#include "gpu/implicit/implicit_solver.h"
#include "gpu/support/body_contact_runs.h"
#include "support/contact_scenes.h"
#include "support/gl_fixture.h"

namespace gelatin {
namespace {

using test::kFrame;

class HeldForcesTest : public test::GlTest {};

// A block that is held at its left side and one that falls on it.
std::shared_ptr<const Model> held_block(MaterialModel material) {
    const Region left = HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.01};
    return test::make_blocks(
        {{.pins = {left}, .model = material}, {.place = {0.05, 0.31, 0.02}, .velocity = {0.0, -1.0, 0.0}}},
        {0, -9.81, 0});
}

template <class SolverType>
HoldingForces forces_of(const std::shared_ptr<const Model>& model, CollisionResponse response) {
    SolverType solver(model, {.response = response}, {.divides_steps = true});
    Pull hand;
    hand.target = {0.5, 0.5, 0.2};
    for (std::uint32_t n = 0; n < model->objects[0].nodes.count; ++n)
        if (model->positions[n].x > 0.25f) hand.nodes.push_back({n, glm::vec3(0.0f), 20.0f});
    solver.set_pulls({hand});
    for (int frame = 0; frame < 8; ++frame) solver.advance({kFrame});
    return solver.holding_forces();
}

TEST_F(HeldForcesTest, AreThoseOfTheCpu) {
    for (const MaterialModel material : {MaterialModel::mass_spring, MaterialModel::neo_hookean})
        for (const CollisionResponse response : {CollisionResponse::restore, CollisionResponse::contact}) {
            const std::shared_ptr<const Model> model = held_block(material);
            const HoldingForces expected = forces_of<cpu::SystemSolver<float>>(model, response),
                                actual = forces_of<gpu::ImplicitSolver>(model, response);
            ASSERT_EQ(actual.by_handle.size(), 1u);
            const double force = glm::length(expected.by_handle[0]);
            EXPECT_GT(force, 100.0);
            EXPECT_LT(glm::distance(actual.by_handle[0], expected.by_handle[0]), 2e-3 * force);
            EXPECT_LT(glm::distance(actual.torques[0], expected.torques[0]), 2e-3 * force);
            ASSERT_EQ(actual.nodes.size(), model->node_count());
            for (std::uint32_t n = 0; n < model->node_count(); ++n)
                EXPECT_LT(glm::distance(actual.nodes[n], expected.nodes[n]), 5e-3 * force) << n;
        }
}

// Of the first handle, after each step.
template <class SolverType>
std::vector<HoldingForces> forces_in_motion(const std::shared_ptr<const Model>& model) {
    SolverType solver(model, {.response = CollisionResponse::contact}, {.divides_steps = true});
    std::vector<HoldingForces> forces;
    for (int frame = 0; frame < 26; ++frame) {
        test::advance(solver, *model, frame);
        forces.push_back(solver.holding_forces());
    }
    return forces;
}

// What a handle gains in speed is its own, also where it waits: not what the rest of its motion would be.
TEST_F(HeldForcesTest, AreThoseOfTheCpuInMotion) {
    for (const auto& model : {test::pushed_block(), test::blocked_block()}) {
        const std::vector<HoldingForces> expected = forces_in_motion<cpu::SystemSolver<float>>(model),
                                         actual = forces_in_motion<gpu::ImplicitSolver>(model);
        double most = 0.0;
        for (const HoldingForces& forces : expected) most = std::max(most, glm::length(forces.by_handle[0]));
        EXPECT_GT(most, 200.0);
        for (std::size_t f = 0; f < expected.size(); ++f) {
            EXPECT_LT(glm::distance(actual[f].by_handle[0], expected[f].by_handle[0]), 2e-3 * most) << f;
            EXPECT_LT(glm::distance(actual[f].torques[0], expected[f].torques[0]), 2e-3 * most) << f;
        }
    }
}

TEST_F(HeldForcesTest, AreNoneBeforeTheFirstStep) {
    gpu::ImplicitSolver solver(held_block(MaterialModel::mass_spring));
    EXPECT_EQ(solver.holding_forces().by_handle[0], glm::dvec3(0.0));
    solver.advance({kFrame});
    EXPECT_NE(solver.holding_forces().by_handle[0], glm::dvec3(0.0));
    State state = solver.read_state();
    state.memory = solver.memory();
    solver.write_state(state);
    EXPECT_EQ(solver.holding_forces().by_handle[0], glm::dvec3(0.0));
}

}  // namespace
}  // namespace gelatin
