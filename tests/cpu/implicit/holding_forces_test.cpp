#include "model/drive/holding_forces.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using test::kFrame;
using test::make_blocks;
using test::make_solver;

constexpr double kHeldWeight = 27.0 * 9.81;  // of a block [N]

// A block that is held carries the one on it; both are on no floor.
TEST(HoldingForces, CarryWhatPressesTheHeldNodes) {
    const Region lower_half = HalfSpaceRegion{{0, 1, 0}, 0.31};  // up to its top
    const auto model = make_blocks({{.pins = {lower_half}}, {.place = {0.02, 0.32, 0.01}}}, {0, -9.81, 0});
    cpu::SystemSolver<float> solver = make_solver<float>(model, 0.8);
    for (int frame = 0; frame < 240; ++frame) solver.advance({kFrame});
    const HoldingForces forces = solver.holding_forces();
    ASSERT_EQ(forces.by_handle.size(), 1u);
    EXPECT_NEAR(forces.by_handle[0].y, 2 * kHeldWeight, 0.01 * kHeldWeight);
}

// What pins exert is what double precision says, node by node.
TEST(HoldingForces, AreThoseOfTheReference) {
    for (const MaterialModel kind : {MaterialModel::mass_spring, MaterialModel::neo_hookean}) {
        const auto model =
            make_blocks({{.pins = {HalfSpaceRegion{{0, 1, 0}, 0.15}}, .poisson_ratio = 0.4, .model = kind}},
                        {0, -9.81, 0});
        cpu::SystemSolver<float> solver = make_solver<float>(model);
        cpu::SystemSolver<double> reference = make_solver<double>(model);
        for (int frame = 0; frame < 5; ++frame) {
            solver.advance({kFrame});
            reference.advance({kFrame});
        }
        const HoldingForces forces = solver.holding_forces(), expected = reference.holding_forces();
        EXPECT_GT(glm::length(expected.by_handle[0]), 0.5 * kHeldWeight);
        for (std::uint32_t n = 0; n < model->node_count(); ++n)
            EXPECT_LT(glm::distance(forces.nodes[n], expected.nodes[n]), 1e-3 * kHeldWeight) << n;
    }
}

TEST(HoldingForces, AreNoneWherePinsAreNone) {
    const auto model = make_blocks({{}}, {0, -9.81, 0});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    solver.advance({kFrame});
    EXPECT_TRUE(solver.holding_forces().by_handle.empty());
}

}  // namespace
}  // namespace gelatin
