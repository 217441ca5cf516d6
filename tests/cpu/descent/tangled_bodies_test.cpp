#include "cpu/descent/tangled_bodies.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <vector>

#include "cpu/elasticity/elastic_energy.h"
#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

using Nodes = std::vector<glm::dvec4>;

// A block of which all nodes have moved and go on at random, pushed by forces at random.
struct TangledBodiesTest : testing::Test {
    std::shared_ptr<const Model> model =
        test::make_blocks({{.youngs_modulus = 1e4}}, glm::dvec3(0, -9.81, 0));
    Nodes starts{model->positions.begin(), model->positions.end()},
        positions = starts, before{model->velocities.begin(), model->velocities.end()}, loads, after;
    ContactForces contacts;

    TangledBodiesTest() {
        test::RandomMaker random(3);
        contacts.normal.resize(starts.size());
        contacts.friction.resize(starts.size());
        for (std::size_t n = 0; n < starts.size(); ++n) {
            positions[n] += glm::dvec4(random.point(0.01), 0.0);
            before[n] = glm::dvec4(random.point(1.0), before[n].w);
            loads.emplace_back(random.point(5.0), 0.0);
            contacts.normal[n] = random.point(20.0);
            contacts.friction[n] = random.point(2.0);
        }
    }

    double mass(std::size_t n) const { return static_cast<double>(model->masses[n]); }
    double kinetic(const Nodes& velocities) const {
        double sum = 0.0;
        for (std::size_t n = 0; n < velocities.size(); ++n)
            sum += 0.5 * mass(n) * glm::dot(glm::dvec3(velocities[n]), glm::dvec3(velocities[n]));
        return sum;
    }
    glm::dvec3 momentum(const Nodes& velocities) const {
        glm::dvec3 sum(0.0);
        for (std::size_t n = 0; n < velocities.size(); ++n) sum += mass(n) * glm::dvec3(velocities[n]);
        return sum;
    }
    glm::dvec3 spin(const Nodes& velocities) const {
        glm::dvec3 sum(0.0);
        for (std::size_t n = 0; n < velocities.size(); ++n)
            sum += mass(n) * glm::cross(glm::dvec3(positions[n]), glm::dvec3(velocities[n]));
        return sum;
    }
    // What kinetic energy may be when the step ends.
    double most() const {
        double sum = kinetic(before) + cpu::body_energy<double>(*model, model->objects[0], starts) -
                     cpu::body_energy<double>(*model, model->objects[0], positions);
        for (std::size_t n = 0; n < starts.size(); ++n)
            sum += glm::dot(mass(n) * glm::dvec3(model->gravity) + glm::dvec3(loads[n]) + contacts.normal[n] +
                                contacts.friction[n],
                            glm::dvec3(positions[n] - starts[n]));
        return sum;
    }
    // Velocities of random directions after the step, besides a rigid motion.
    void go(double speed) {
        test::RandomMaker random(5);
        after = before;
        for (std::size_t n = 0; n < after.size(); ++n)
            after[n] = glm::dvec4(glm::dvec3(0.1, 0.2, 0) +
                                      glm::cross(glm::dvec3(0, 0, 0.5), glm::dvec3(positions[n])) +
                                      random.point(speed),
                                  before[n].w);
    }
    void run() {
        const std::vector<std::uint32_t> objects{0};
        cpu::TangledBodies<double>(model).slow_down({starts, positions, before, loads, contacts}, objects,
                                                    after);
    }
};

TEST_F(TangledBodiesTest, HaveNoMoreEnergyThanTheyWereGiven) {
    go(3.0);
    const Nodes fast = after;
    ASSERT_GT(kinetic(fast), 1.5 * most());
    ASSERT_GT(most(), 0.0);
    run();
    EXPECT_NEAR(kinetic(after), most(), 1e-6 * most());
    EXPECT_LT(glm::length(momentum(after) - momentum(fast)), 1e-9 * glm::length(momentum(fast)));
    EXPECT_LT(glm::length(spin(after) - spin(fast)), 1e-5 * glm::length(spin(fast)));
}

TEST_F(TangledBodiesTest, KeepWhatTheyWereGiven) {
    go(0.5);
    const Nodes slow = after;
    ASSERT_LT(kinetic(slow), most());
    run();
    EXPECT_EQ(after, slow);
}

// What others have pushed it into takes all motion but the rigid one.
TEST_F(TangledBodiesTest, StayRigidWhereNothingIsLeft) {
    go(1.0);
    for (glm::dvec4& velocity : before) velocity *= 1e-3;
    for (glm::dvec3& force : contacts.normal) force = glm::dvec3(0.0);
    ASSERT_LT(most(), 0.0);
    const glm::dvec3 before_it = momentum(after);
    run();
    EXPECT_LT(glm::length(momentum(after) - before_it), 1e-9 * glm::length(before_it));
    double between = 0.0;
    for (std::size_t n = 1; n < after.size(); ++n)
        between = std::max(between, std::abs(glm::dot(glm::dvec3(after[n] - after[0]),
                                                      glm::dvec3(positions[n] - positions[0]))));
    EXPECT_LT(between, 1e-5);  // distances do not change
}

// A body that is stretched and was to get its shape back turns as one of its size does.
TEST_F(TangledBodiesTest, TurnWithTheAngularMomentumOfTheShapeTheyWereToHave) {
    go(0.0);
    cpu::Nodes<double> nodes{positions, after};
    for (glm::dvec4& p : nodes.positions) p = glm::dvec4(5.0 * glm::dvec3(p), p.w);
    cpu::TangledBodies<double>(model).move_rigidly(0, positions, nodes);
    const auto own_spin = [&](const Nodes& velocities) {  // about the centre of mass
        return spin(velocities) -
               glm::cross(momentum(positions) / model->objects[0].mass, momentum(velocities));
    };
    const glm::dvec3 had_spin = own_spin(after);
    positions = nodes.positions;
    EXPECT_LT(glm::length(momentum(nodes.velocities) - momentum(after)), 1e-9 * glm::length(momentum(after)));
    EXPECT_LT(glm::length(own_spin(nodes.velocities) - had_spin), 1e-5 * glm::length(had_spin));
    const double rate = glm::length(glm::dvec3(nodes.velocities.front() - nodes.velocities.back())) /
                        glm::length(glm::dvec3(positions.front() - positions.back()));
    EXPECT_LT(rate, 0.5 / 20.0);
    for (std::size_t n = 0; n < after.size(); ++n) EXPECT_EQ(nodes.velocities[n].w, after[n].w);
}

// It does so in any step that is as long as the last one, too; after shorter ones it vibrates faster.
TEST(Guess, OfABarThatVibratesIsNoMoreThanItHasInALongerStep) {
    const auto model = test::make_blocks(
        {{.cells = {10, 1, 1}, .size = {1.0, 0.1, 0.1}, .youngs_modulus = 3.6e7}, {.place = {0, 3, 0}}});
    auto solver = test::make_solver<double>(model, 0.0, 10, true);
    const ModelObject& bar = model->objects[0];
    const auto energy = [&] {
        const auto& [positions, velocities] = solver.nodes();
        double sum = cpu::body_energy<double>(*model, bar, positions);
        for (std::uint32_t n = bar.nodes.first; n < bar.nodes.end(); ++n)
            sum += 0.5 * static_cast<double>(model->masses[n]) *
                   glm::dot(glm::dvec3(velocities[n]), glm::dvec3(velocities[n]));
        return sum;
    };
    test::RandomMaker random(5);
    for (int round = 0; round < 4; ++round) {
        auto state = solver.read_state();
        for (std::uint32_t n = bar.nodes.first; n < bar.nodes.end(); ++n)
            state.velocities[n] += glm::vec4(random.point(2.0), 0.0f);
        solver.write_state(state);
        for (int part = 0; part < 16; ++part) solver.advance({test::kFrame / 16});
        const double before = energy();
        solver.advance({test::kFrame});
        EXPECT_LT(energy(), before) << round;
    }
}

}  // namespace
}  // namespace gelatin
