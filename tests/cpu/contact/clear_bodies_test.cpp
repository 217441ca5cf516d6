// Steps in which nothing is near anything else.
#include "cpu/contact/clear_bodies.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/stage_timer.h"
#include "support/contact_scenes.h"
#include "support/overlaps.h"

namespace gelatin {
namespace {

using test::Block;
using test::kFrame;

cpu::ImplicitSolver<float> make_solver(const std::shared_ptr<const Model>& model, bool meets_itself) {
    return cpu::ImplicitSolver<float>(model,
                                      CollisionSettings{.response = CollisionResponse::contact,
                                                        .self_collision = meets_itself,
                                                        .friction = 0.4,
                                                        .restitution = 0.0},
                                      DescentSettings{.divides_steps = true});
}

// One that hangs and swings.
TEST(StepsWithoutContacts, AreThoseOfABodyThatMayPassThroughItself) {
    const auto model = test::make_blocks(
        {{.velocity = {1, 0, 0}, .youngs_modulus = 2e4, .pins = {HalfSpaceRegion{{0, -1, 0}, -0.29}}}},
        {0, -9.81, 0});
    cpu::ImplicitSolver<float> solver = make_solver(model, true), without = make_solver(model, false);
    for (int frame = 0; frame < 60; ++frame) {
        solver.advance({kFrame});
        without.advance({kFrame});
        ASSERT_EQ(solver.nodes().positions, without.nodes().positions) << frame;
    }
    EXPECT_NE(solver.nodes().positions, model->positions);
}

// Bodies that fly past each other are apart, those that meet are not.
TEST(StepsWithoutContacts, EndWhereBodiesMeet) {
    for (const bool meet : {false, true}) {
        const double height = meet ? 0.0 : 1.0;
        const auto model = test::make_blocks({{.place = {0, 0, 0}, .velocity = {2, 0, 0}},
                                              {.place = {1.5, height, 0}, .velocity = {-2, 0, 0}}});
        cpu::ImplicitSolver<float> solver = make_solver(model, true), without = make_solver(model, false);
        solver.stage_timer().time_parts(true);
        for (int frame = 0; frame < 45; ++frame) {
            solver.advance({kFrame});
            ASSERT_EQ(test::count_overlaps(*model, solver.nodes().positions), 0u) << frame;
        }
        const auto times = solver.stage_timer().take();
        EXPECT_EQ(times.contains("advance_nodes.aim"), meet);
    }
}

// A bar that is pressed flat, and let go.
TEST(ClearBodies, AreClearAgain) {
    const auto model = test::make_blocks({{.cells = {8, 2, 2}, .size = {0.8, 0.2, 0.2}}});
    const auto surface =
        std::make_shared<const ContactSurface>(make_contact_surface(*model, {.friction = 0.4}));
    cpu::ClearBodies<double> bodies(model, surface);
    const std::vector<glm::dvec4> at_rest(model->positions.begin(), model->positions.end());
    std::vector<glm::dvec4> flat = at_rest;
    for (glm::dvec4& p : flat) p.y *= 0.01;
    EXPECT_TRUE(bodies.stay_clear(at_rest, at_rest));
    EXPECT_TRUE(bodies.is_clear(0));
    EXPECT_FALSE(bodies.stay_clear(at_rest, flat));
    EXPECT_FALSE(bodies.is_clear(0));
    EXPECT_TRUE(bodies.stay_clear(flat, flat));  // it is guarded now
    const auto is_near = [](std::uint32_t) { return true; };
    int steps = 0;
    while (bodies.find(at_rest, is_near).empty() && steps < 100) ++steps;
    EXPECT_GT(steps, 3);
    EXPECT_LT(steps, 100);
    EXPECT_TRUE(bodies.is_clear(0));
}

// One corner is drawn through the body, and out of it again.
TEST(ClearBodies, ThatPassThroughThemselvesComeApart) {
    const auto model = test::make_blocks({{.youngs_modulus = 2e4}});
    std::vector<glm::vec4> positions = model->positions;
    const auto corner =
        std::min_element(positions.begin(), positions.end(),
                         [](const auto& a, const auto& b) { return a.x + a.y + a.z < b.x + b.y + b.z; });
    *corner += glm::vec4(0.35f, 0.35f, 0.35f, 0.0f);
    EXPECT_GT(test::count_overlaps(*model, positions, test::Overlaps::all), 0u);
    cpu::ImplicitSolver<float> solver = make_solver(model, true);
    solver.write_state({positions, model->velocities, {}});
    for (int frame = 0; frame < 60; ++frame) solver.advance({kFrame});
    EXPECT_EQ(test::count_overlaps(*model, solver.nodes().positions, test::Overlaps::all), 0u);
}

}  // namespace
}  // namespace gelatin
