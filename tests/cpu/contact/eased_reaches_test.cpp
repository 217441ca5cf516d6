// Bodies that start nearer than they press each other are not thrown apart.
#include "cpu/contact/eased_reaches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/contact/contacts.h"
#include "support/contact_scenes.h"

namespace gelatin {
namespace {

using test::Block;
using test::make_blocks;

// Two blocks of 0.3 m beside each other, and one farther away, which the second reaches.
struct Beside {
    std::shared_ptr<const Model> model;
    cpu::Contacts<double> contacts;

    Beside(double gap, double second_gap)
        : model(make_blocks({{}, {.place = {0.3 + gap, 0, 0}}, {.place = {0.6 + gap + second_gap, 0, 0}}})),
          contacts(model, {.response = CollisionResponse::contact, .self_collision = false}) {
        contacts.start();
    }
    double whole() const { return contacts.thickness(0) + contacts.thickness(1); }
    // Of the pairs of two objects; 0: there are none.
    double reach(std::uint32_t object, std::uint32_t other) const {
        double reach = 0.0;
        for (const cpu::ContactPair& pair : contacts.list().pairs) {
            if (std::minmax(pair.object, pair.other) != std::minmax(object, other)) continue;
            EXPECT_TRUE(reach == 0.0 || reach == static_cast<double>(pair.reach));
            reach = static_cast<double>(pair.reach);
        }
        return reach;
    }
};

TEST(EasedReaches, BeginWithTheGapAndGrow) {
    const double gap = 0.002;
    Beside beside(gap, 0.012);
    const double whole = beside.whole();
    ASSERT_GT(whole, 1.5 * gap);
    ASSERT_LT(whole, 0.012);
    EXPECT_NEAR(beside.reach(0, 1), gap, 1e-6);
    EXPECT_NEAR(beside.reach(1, 2), beside.contacts.thickness(1) + beside.contacts.thickness(2), 1e-8)
        << "that starts farther away";
    for (int part = 1; part <= 8; ++part) {
        beside.contacts.ease(1.0 / 30.0);  // of the third of a second that all of it takes
        EXPECT_NEAR(beside.reach(0, 1), std::min(whole, gap + 0.1 * part * whole), 1e-6) << part;
    }
    EXPECT_NEAR(beside.reach(0, 1), whole, 1e-7);
}

TEST(EasedReaches, AreWholeAgainAfterARestart) {
    Beside beside(0.002, 0.012);
    beside.contacts.restart(
        std::vector<glm::dvec4>(beside.model->positions.begin(), beside.model->positions.end()));
    beside.contacts.are_apart(
        1e-3,
        {std::vector<glm::dvec4>(beside.model->positions.begin(), beside.model->positions.end()),
         std::vector<glm::dvec4>(beside.model->node_count())},
        nullptr);
    EXPECT_NEAR(beside.reach(0, 1), beside.whole(), 1e-8);
}

// A block that starts just above a box is lifted within a third of a second, and not faster, in steps of any
// length.
TEST(EasedReachesHeavy, NothingIsThrownAtTheStart) {
    ColliderDescription box;
    box.shape = BoxShape{{2.0, 0.2, 2.0}};
    box.position = {0.15, -0.1, 0.15};
    for (const double youngs_modulus : {1e6, 1e8})
        for (const double gap : {1e-5, 1e-4, 1e-3, 5e-3})
            for (const int steps : {1, 16}) {
                const auto model = make_blocks({{.place = {0, gap, 0}, .youngs_modulus = youngs_modulus}},
                                               {0.0, -9.81, 0.0}, {box});
                auto solver = test::make_solver<float>(model);
                double fastest = 0.0;
                for (int step = 0; step < 30 * steps; ++step) {
                    test::advance(solver, *model, step, test::kFrame / steps);
                    glm::dvec3 sum(0.0);
                    for (const glm::vec4& velocity : solver.read_state().velocities)
                        sum += glm::dvec3(velocity) / static_cast<double>(model->node_count());
                    fastest = std::max(fastest, sum.y);
                }
                EXPECT_LT(fastest, 0.05) << youngs_modulus << ' ' << gap << ' ' << steps;
            }
}

}  // namespace
}  // namespace gelatin
