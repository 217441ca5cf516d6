#include "cpu/implicit/rigid_solve.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// Three free blocks, and rows between them and with a plane.
class RigidSolveTest : public testing::Test {
protected:
    RigidSolveTest()
        : model_(test::make_blocks({{}, {.place = {0.4, 0, 0}}, {.place = {0, 0.4, 0.1}}})),
          level_(begun_level()),
          rows_(make_rows()),
          forces_(rows_.size()),
          slips_(rows_.size()),
          island_{rows_, tangents_, forces_, slips_},
          bodies_(*model_, level_, {0, 1, 2}, island_, pairs_) {}

    cpu::RigidLevel<double> begun_level() {
        const std::vector<glm::dvec4> positions(model_->positions.begin(), model_->positions.end());
        inertia_.assign(positions.size(), 0.0);
        for (std::size_t n = 0; n < positions.size(); ++n) inertia_[n] = 1e4 * model_->masses[n];
        cpu::RigidLevel<double> level(model_);
        level.begin(positions, inertia_);
        return level;
    }
    std::vector<cpu::ContactRow<double>> make_rows() {
        std::vector<cpu::ContactRow<double>> rows;
        const std::array<std::array<std::uint32_t, 2>, 5> sides{
            {{0, 1}, {0, 1}, {1, 2}, {2, 0}, {kNoNode, 1}}};
        for (const auto& [object, other] : sides) {
            if (pairs_.empty() || pairs_.back().object != object || pairs_.back().other != other)
                pairs_.push_back({object, other, {static_cast<std::uint32_t>(rows.size()), 0}});
            ++pairs_.back().rows.count;
            add_row(object, other, rows);
        }
        return rows;
    }
    void add_row(std::uint32_t object, std::uint32_t other, std::vector<cpu::ContactRow<double>>& rows) {
        cpu::ContactRow<double> row;
        row.object = object;
        row.other = other;
        const auto add = [&](std::uint32_t body, std::uint32_t number, double weight) {
            row.nodes[row.count] = model_->objects[body].nodes.first + number;
            row.weights[row.count++] = weight;
        };
        const auto number = static_cast<std::uint32_t>(rows.size());
        if (object != kNoNode) add(object, 3 + number, -1.0);
        add(other, 5, 0.3);
        add(other, 20 + number, 0.7);
        rows.push_back(row);
        cpu::RowTangent<double> tangent;
        tangent.stiffness.add_identity(100.0 * (1.0 + number));
        tangent.stiffness.add_outer(1e5, glm::normalize(glm::dvec3(1.0, 0.2 * number, -0.5)));
        tangents_.push_back(tangent);
    }

    std::shared_ptr<const Model> model_;
    std::vector<double> inertia_;
    std::vector<cpu::RowTangent<double>> tangents_;
    cpu::RigidLevel<double> level_;
    std::vector<cpu::RowPair> pairs_;
    std::vector<cpu::ContactRow<double>> rows_;
    std::vector<glm::dvec3> forces_, slips_;
    cpu::IslandRows<double> island_;
    cpu::RigidSolve<double> bodies_;
};

// E q = forces, with E as it is written: inertia, and what rows resist with.
TEST_F(RigidSolveTest, SolvesForMotions) {
    test::RandomMaker random(3);
    std::vector<cpu::Motion> forces(bodies_.count());
    for (cpu::Motion& force : forces)
        for (int k = 0; k < 6; ++k) force(k) = random.uniform(-1.0, 1.0);
    bodies_.find_matrix(tangents_);
    std::vector<cpu::Motion> motions = forces;
    EXPECT_LE(bodies_.solve(motions, 1e-24), 25u);  // 18 unknowns, but for rounding
    for (std::size_t r = 0; r < rows_.size(); ++r)
        forces_[r] = tangents_[r].stiffness * bodies_.relative(r, motions);
    std::vector<cpu::Motion> resistance(motions.size());
    for (std::uint32_t b = 0; b < motions.size(); ++b) resistance[b] = level_.matrix(b) * motions[b];
    bodies_.add_rows(resistance);
    for (std::size_t b = 0; b < forces.size(); ++b)
        EXPECT_LT((resistance[b] - forces[b]).norm(), 1e-9 * forces[b].norm()) << b;
}

// s of rows is that of the nodes' displacements, and what rows exert on bodies is W^T of their forces.
TEST_F(RigidSolveTest, DisplacesNodesAsItGathersForces) {
    test::RandomMaker random(5);
    std::vector<cpu::Motion> motions(bodies_.count());
    for (cpu::Motion& motion : motions)
        for (int k = 0; k < 6; ++k) motion(k) = random.uniform(-0.1, 0.1);
    std::vector<glm::dvec3> displacements(inertia_.size());
    for (std::uint32_t n = 0; n < displacements.size(); ++n) displacements[n] = level_.at(n, motions);
    double work = 0.0, same = 0.0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const glm::dvec3 s = cpu::relative<double>(rows_[r], displacements);
        EXPECT_LT(glm::distance(bodies_.relative(r, motions), s), 1e-12);
        EXPECT_LT(glm::distance(level_.relative(rows_[r], motions), s), 1e-12);
        forces_[r] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        work += glm::dot(forces_[r], s);
    }
    std::vector<cpu::Motion> gathered(motions.size(), cpu::Motion::Zero());
    bodies_.add_rows(gathered);
    for (std::size_t b = 0; b < motions.size(); ++b) same += gathered[b].dot(motions[b]);
    EXPECT_NEAR(work, same, 1e-9);
}

}  // namespace
}  // namespace gelatin
