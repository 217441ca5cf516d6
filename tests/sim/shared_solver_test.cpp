#include "sim/shared_solver.h"

#include <gtest/gtest.h>

#include "support/contact_scenes.h"
#include "support/gl_fixture.h"
#include "support/overlaps.h"

namespace gelatin {
namespace {

using test::kFrame;

class SharedSolverTest : public test::GlTest {};
using SharedSolverHeavy = SharedSolverTest;
using SharedSolverLong = SharedSolverTest;

SharedSolver make_solver(const std::shared_ptr<const Model>& model, int iterations = 10,
                         bool divides_steps = false) {
    CollisionSettings collision;
    collision.response = CollisionResponse::contact;
    collision.self_collision = true;
    collision.friction = 0.4;
    collision.restitution = 0.0;
    ImplicitSettings descent;
    descent.iterations = iterations;
    descent.divides_steps = divides_steps;
    return {model, collision, descent};
}

std::uint32_t overlaps_of(const Model& model, SharedSolver& solver) {
    const std::vector<glm::vec4> positions = solver.read_state().positions;
    return test::count_overlaps(model, std::vector<cpu::Vec4<float>>(positions.begin(), positions.end()));
}

ColliderDescription floor() {
    ColliderDescription description;
    description.shape = PlaneCollider{};
    return description;
}

std::shared_ptr<const Model> make_stack() {
    return test::make_blocks({{.place = {0, 0.001, 0}, .youngs_modulus = 1e6},
                              {.place = {0.02, 0.32, 0.01}, .velocity = {0, -1, 0}, .youngs_modulus = 1e6}},
                             {0, -9.81, 0}, {floor()});
}

// What is drawn and measured is what the host has made.
TEST_F(SharedSolverTest, TheDeviceHasTheNodesOfTheHost) {
    const auto model = make_stack();
    SharedSolver solver = make_solver(model);
    for (int frame = 0; frame < 3; ++frame) solver.advance({kFrame});
    const State state = solver.read_state();
    gl::barrier(gl::Barrier::buffer_update);
    std::vector<glm::vec4> positions(model->node_count()), velocities(model->node_count());
    solver.nodes().positions.download(positions);
    solver.nodes().velocities.download(velocities);
    EXPECT_EQ(positions, state.positions);
    EXPECT_EQ(velocities, state.velocities);
    EXPECT_NE(positions, model->positions);
}

TEST_F(SharedSolverHeavy, DoesWhatTheCpuDoes) {
    const auto model = make_stack();
    SharedSolver solver = make_solver(model, 10, true);
    auto reference = test::make_solver<float>(model, 0.4, 10, true);
    for (int frame = 0; frame < 120; ++frame) {
        solver.advance({kFrame});
        reference.advance({kFrame});
        ASSERT_EQ(overlaps_of(*model, solver), 0u) << frame;
    }
    EXPECT_EQ(solver.read_state().positions, reference.nodes().positions);
    double weight = 0.0;  // of both on the floor [N]
    for (const ContactForces::Between& between : solver.contact_forces().between)
        if (between.is_plane) weight += between.normal.y;
    EXPECT_NEAR(weight, 9.81 * (model->objects[0].mass + model->objects[1].mass), 0.01 * weight);
}

TEST_F(SharedSolverTest, RepeatsBitForBitAndStartsAgain) {
    const auto model = make_stack();
    SharedSolver solver = make_solver(model), again = make_solver(model);
    const State start = solver.read_state();
    for (int frame = 0; frame < 20; ++frame) {
        solver.advance({kFrame});
        again.advance({kFrame});
    }
    const State end = solver.read_state();
    EXPECT_EQ(again.read_state().positions, end.positions);
    again.write_state(start);
    for (int frame = 0; frame < 20; ++frame) again.advance({kFrame});
    EXPECT_EQ(again.read_state().positions, end.positions);
}

void fuzz(unsigned first, unsigned count) {
    for (unsigned seed = first; seed < first + count; ++seed) {
        const test::ViolentScene scene = test::violent_scene(seed);
        SharedSolver solver = make_solver(scene.model, scene.iterations, scene.divides_steps);
        const auto energy_of = [&] {
            const State state = solver.read_state();
            return test::sum_bodies<float>(*scene.model, {state.positions, state.velocities});
        };
        const test::BodySums energy = energy_of();
        for (int step = 0; step < 15; ++step) {
            solver.advance({scene.step});
            ASSERT_EQ(overlaps_of(*scene.model, solver), 0u) << "scene " << seed << ", step " << step;
            ASSERT_LE(energy_of().sum(), energy.sum() + 0.2 * energy.kinetic)
                << "scene " << seed << ", step " << step;
        }
    }
}

TEST_F(SharedSolverTest, NothingPassesThroughAnything) {
    fuzz(1, 3);
}

TEST_F(SharedSolverLong, NothingPassesThroughAnything) {
    fuzz(100, 500);
}

}  // namespace
}  // namespace gelatin
