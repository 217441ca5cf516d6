#include "cpu/implicit/step_system.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "support/contact_scenes.h"
#include "support/converted.h"
#include "support/elastic_cases.h"

namespace gelatin {
namespace {

constexpr double kInverseLength = 240.0;  // of the step [1/s]

// Four blocks: the first two press each other, and so do the others, with far more than the first.
class StepSystemTest : public testing::Test {
protected:
    StepSystemTest()
        : model_(
              test::make_blocks({{}, {.place = {0.4, 0, 0}}, {.place = {0, 2, 0}}, {.place = {0.4, 2, 0}}})) {
    }

    // @param push how far the second pair is pushed together [m]
    void begin(cpu::StepSystem<double>& system, double push) const {
        const std::vector<glm::dvec4> positions = test::converted<double>(model_->positions);
        const std::vector<glm::dvec3> pushes = test::random_field<double>(model_->node_count(), 1);
        for (std::uint32_t n = 0; n < model_->node_count(); ++n) {
            const bool is_second = n >= model_->objects[2].nodes.first;
            system.inertia[n] = kInverseLength * kInverseLength * model_->masses[n];
            system.loads[n] = (is_second ? push : 1e-3) * system.inertia[n] * pushes[n];
            system.displacements[n] = glm::dvec3(0.0);
        }
        system.rows.clear();
        add_row(0, 1, system.rows);
        add_row(2, 3, system.rows);
        add_row(1, 0, system.rows);
        system.elastic.linearise(positions, test::converted<double>(model_->velocities), kInverseLength);
        system.enough.assign(system.enough.size(), 1e-9);
    }
    std::vector<glm::dvec3> solve(cpu::StepSystem<double>& system) const {
        system.rigid.begin(test::converted<double>(model_->positions), system.inertia);
        system.solve(std::vector<std::uint32_t>{0, 0, 2, 2});
        EXPECT_GT(system.counts.iterations, 2);
        return system.displacements;
    }
    std::vector<glm::dvec3> solve(double push) const {
        cpu::StepSystem<double> system(model_);
        begin(system, push);
        return solve(system);
    }
    // As nodes of a handle that moves.
    void hold(cpu::StepSystem<double>& system, const Range& nodes) const {
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            system.inertia[n] = 0.0;
            system.loads[n] = glm::dvec3(0.0);
            system.displacements[n] = {1e-3, 0.0, 0.0};
        }
    }

    std::shared_ptr<const Model> model_;

private:
    void add_row(std::uint32_t object, std::uint32_t other,
                 std::vector<cpu::ContactRow<double>>& rows) const {
        cpu::ContactRow<double> row;
        row.object = object;
        row.other = other;
        row.normal = {1.0, 0.0, 0.0};
        row.gap = 1e-3;
        row.reach = 2e-3;
        row.stiffness = 1e4;
        row.friction = 0.4;
        row.count = 2;
        row.nodes = {model_->objects[object].nodes.first + 3, model_->objects[other].nodes.first + 7};
        row.weights = {-1.0, 1.0};
        rows.push_back(row);
    }
};

TEST_F(StepSystemTest, SolvesEachIslandByItself) {
    const std::vector<glm::dvec3> gentle = solve(1e-3), hard = solve(0.1);
    const std::uint32_t first_pair = model_->objects[2].nodes.first;
    for (std::uint32_t n = 0; n < first_pair; ++n) EXPECT_EQ(gentle[n], hard[n]) << n;
    EXPECT_NE(gentle[first_pair], hard[first_pair]);
}

// What is held now, or not solved at all, has moved before.
TEST_F(StepSystemTest, ForgetsWhatWasSolvedBefore) {
    for (const std::uint8_t asleep : {0, 1}) {
        const std::vector<std::uint8_t> left_out{0, asleep, 0, 0};
        const auto solve_held = [&](cpu::StepSystem<double>& system) {
            if (asleep != 0) system.leave_out(left_out);
            begin(system, 1e-3);
            hold(system, model_->objects[1].nodes);
            return solve(system);
        };
        cpu::StepSystem<double> fresh(model_), used(model_);
        begin(used, 0.1);
        solve(used);
        EXPECT_TRUE(solve_held(used) == solve_held(fresh));
        used.elastic_forces();
        EXPECT_TRUE(solve_held(used) == solve_held(fresh));
    }
}

}  // namespace
}  // namespace gelatin
