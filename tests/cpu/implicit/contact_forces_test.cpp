#include "cpu/implicit/system_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using test::kFrame;
using test::make_blocks;
using test::make_solver;
using Between = ContactForces::Between;

constexpr double kWeight = 27.0 * 9.81;  // of a block [N]

ColliderDescription table() {
    ColliderDescription description;
    description.shape = Shape{BoxShape{{4, 1, 4}}};
    description.position = {0, -0.5, 0};
    description.friction = 0.8;
    return description;
}

Between only(const ContactForces& forces, std::uint32_t object, bool is_plane, std::uint32_t other) {
    const auto found = std::find_if(forces.between.begin(), forces.between.end(), [&](const Between& b) {
        return b.object == object && b.is_plane == is_plane && b.other == other;
    });
    return found == forces.between.end() ? Between{} : *found;
}

ContactForces forces_at_rest(const std::shared_ptr<const Model>& model) {
    cpu::SystemSolver<float> solver = make_solver<float>(model, 0.8);
    for (int frame = 0; frame < 240; ++frame) solver.advance({kFrame});
    return solver.contact_forces();
}

// Two blocks on each other: the lower one carries both.
TEST(ContactForces, AreTheWeightOfWhatRests) {
    const std::vector<test::Block> blocks{{.place = {0, 0.01, 0}, .youngs_modulus = 1e6},
                                          {.place = {0.02, 0.33, 0.01}, .youngs_modulus = 1e6}};
    for (const bool is_plane : {true, false}) {
        const auto model = make_blocks(blocks, {0, -9.81, 0}, {is_plane ? ColliderDescription{} : table()});
        const ContactForces forces = forces_at_rest(model);
        ASSERT_EQ(forces.between.size(), 2u);
        const Between below = only(forces, 0, is_plane, is_plane ? 0 : 2), above = only(forces, 0, false, 1);
        EXPECT_NEAR(below.normal.y, 2 * kWeight, 0.01 * kWeight) << is_plane;
        EXPECT_NEAR(above.normal.y, -kWeight, 0.01 * kWeight) << is_plane;
        EXPECT_LT(glm::length(below.friction + above.friction + glm::dvec3(0, kWeight, 0) + below.normal +
                              above.normal - glm::dvec3(0, 2 * kWeight, 0)),
                  0.02 * kWeight);
        EXPECT_GT(below.points, 4u);
        // The nodes' are the same forces; those between objects cancel.
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = 0; n < model->body_node_count(); ++n)
            sum += forces.normal[n] + forces.friction[n];
        EXPECT_LT(glm::length(sum - below.normal - below.friction), 1e-3 * kWeight);
    }
}

// On an incline friction carries what pulls.
TEST(ContactForces, HaveFriction) {
    const glm::dvec3 gravity = 9.81 * glm::normalize(glm::dvec3(0.3, -1, 0)), weight = 18.0 * gravity;
    for (const bool is_plane : {true, false}) {
        ColliderDescription plane;
        plane.friction = 0.8;
        const auto model =
            make_blocks({{.place = {0, 0.01, 0}, .size = {0.3, 0.2, 0.3}, .youngs_modulus = 1e6}}, gravity,
                        {is_plane ? plane : table()});
        const ContactForces forces = forces_at_rest(model);
        ASSERT_EQ(forces.between.size(), 1u);
        EXPECT_NEAR(forces.between[0].normal.y, -weight.y, 0.01 * kWeight) << is_plane;
        EXPECT_NEAR(forces.between[0].friction.x, -weight.x, 0.01 * kWeight) << is_plane;
        EXPECT_NEAR(forces.between[0].friction.y, 0.0, 1e-3 * kWeight) << is_plane;
    }
}

// What was found belongs to the state that was there.
TEST(ContactForces, AreNoneOfAStateThatIsNew) {
    const auto model = make_blocks({{}, {.place = {0, 0.31, 0}}}, {0, -9.81, 0}, {ColliderDescription{}});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    for (int frame = 0; frame < 10; ++frame) solver.advance({kFrame});
    EXPECT_FALSE(solver.contact_forces().between.empty());
    solver.write_state({model->positions, model->velocities, {}});
    const ContactForces forces = solver.contact_forces();
    EXPECT_TRUE(forces.between.empty());
    ASSERT_EQ(forces.normal.size(), model->node_count());
    for (const glm::dvec3& force : forces.normal) EXPECT_EQ(force, glm::dvec3(0));
}

TEST(ContactForces, AreNoneInTheAir) {
    const auto model = make_blocks({{}, {.place = {2, 0, 0}}}, {0, -9.81, 0});
    cpu::SystemSolver<float> solver = make_solver<float>(model);
    solver.advance({kFrame});
    const ContactForces forces = solver.contact_forces();
    EXPECT_TRUE(forces.between.empty());
    for (const glm::dvec3& force : forces.normal) EXPECT_EQ(force, glm::dvec3(0));
}

}  // namespace
}  // namespace gelatin
