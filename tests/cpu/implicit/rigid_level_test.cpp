#include "cpu/implicit/rigid_level.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin {
namespace {

// Three free blocks, and rows between them, with a plane, and within one.
class RigidLevelTest : public testing::Test {
protected:
    RigidLevelTest()
        : model_(test::make_blocks({{}, {.place = {0.4, 0, 0}}, {.place = {0, 0.4, 0.1}}})), level_(model_) {
        const std::vector<glm::dvec4> positions(model_->positions.begin(), model_->positions.end());
        inertia_.assign(positions.size(), 0.0);
        for (std::size_t n = 0; n < positions.size(); ++n) inertia_[n] = 1e4 * model_->masses[n];
        level_.begin(positions, inertia_);
        add_row(0, 1);
        add_row(2, 0);
        add_row(1, 2);
        add_row(kNoNode, 1);
        add_row(2, 2);
        add_row(0, 1);
        level_.set_rows(rows_);
    }
    void add_row(std::uint32_t object, std::uint32_t other) {
        cpu::ContactRow<double> row;
        row.object = object;
        row.other = other;
        const auto add = [&](std::uint32_t body, std::uint32_t number, double weight) {
            row.nodes[row.count] = model_->objects[body].nodes.first + number;
            row.weights[row.count++] = weight;
        };
        const auto number = static_cast<std::uint32_t>(rows_.size());
        if (object != kNoNode) add(object, 3 + number, -1.0);
        add(other, 5, 0.3);
        add(other, 20 + number, 0.7);
        rows_.push_back(row);
        cpu::RowTangent<double> tangent;
        tangent.stiffness.add_identity(100.0 * (1.0 + number));
        tangent.stiffness.add_outer(1e5, glm::normalize(glm::dvec3(1.0, 0.2 * number, -0.5)));
        tangents_.push_back(tangent);
    }

    std::shared_ptr<const Model> model_;
    cpu::RigidLevel<double> level_;
    std::vector<double> inertia_;
    std::vector<cpu::ContactRow<double>> rows_;
    std::vector<cpu::RowTangent<double>> tangents_;
};

// E q = forces, with E as it is written: inertia, and what rows resist with.
TEST_F(RigidLevelTest, SolvesForMotions) {
    test::RandomMaker random(3);
    std::vector<cpu::Motion> forces(level_.count());
    for (cpu::Motion& force : forces)
        for (int k = 0; k < 6; ++k) force(k) = random.uniform(-1.0, 1.0);
    level_.factorise(tangents_);
    std::vector<cpu::Motion> motions = forces;
    level_.solve(motions);
    std::vector<glm::dvec3> row_forces;
    for (std::size_t r = 0; r < rows_.size(); ++r)
        row_forces.push_back(tangents_[r].stiffness * level_.relative(r, motions));
    std::vector<cpu::Motion> resistance = level_.resistance(motions);
    level_.add_rows(row_forces, resistance);
    for (std::size_t b = 0; b < forces.size(); ++b)
        EXPECT_LT((resistance[b] - forces[b]).norm(), 1e-9 * forces[b].norm()) << b;
}

// W q, W^T r, and s of rows are of the same W.
TEST_F(RigidLevelTest, DisplacesNodesAsItGathersThem) {
    test::RandomMaker random(5);
    std::vector<cpu::Motion> motions(level_.count());
    for (cpu::Motion& motion : motions)
        for (int k = 0; k < 6; ++k) motion(k) = random.uniform(-0.1, 0.1);
    std::vector<glm::dvec3> displacements(inertia_.size()), residual(inertia_.size());
    const cpu::ObjectPieces nodes(cpu::node_ranges(*model_));
    level_.for_displacements(nodes, motions,
                             [&](std::size_t n, const glm::dvec3& d) { displacements[n] = d; });
    double work = 0.0, same = 0.0;
    for (std::size_t n = 0; n < residual.size(); ++n) {
        residual[n] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
        work += glm::dot(residual[n], displacements[n]);
    }
    const std::vector<cpu::Motion> gathered = level_.gather(residual);
    for (std::size_t b = 0; b < motions.size(); ++b) same += gathered[b].dot(motions[b]);
    EXPECT_NEAR(work, same, 1e-9);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        EXPECT_LT(glm::distance(level_.relative(r, motions), cpu::relative<double>(rows_[r], displacements)),
                  1e-12);
}

}  // namespace
}  // namespace gelatin
