#include "cpu/implicit/glued_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "cpu/implicit/step_system.h"
#include "support/contact_scenes.h"
#include "support/converted.h"
#include "support/elastic_cases.h"

namespace gelatin {
namespace {

constexpr double kInverseLength = 240.0;  // of the step [1/s]

// Three blocks in a row, each glued to the one before by the nodes of a side.
class GluedNodesTest : public testing::Test {
protected:
    GluedNodesTest()
        : model_(test::make_blocks({{.cells = kCells, .size = glm::dvec3(0.3)},
                                    {.place = {0.3, 0, 0}, .cells = kCells, .size = glm::dvec3(0.3)},
                                    {.place = {0.6, 0, 0}, .cells = kCells, .size = glm::dvec3(0.3)}})) {
        for (std::uint32_t n = 0; n < model_->node_count(); ++n)
            inertia_.push_back(kInverseLength * kInverseLength * model_->masses[n]);
    }

    static cpu::ContactRow<double> tie(std::uint32_t object, std::uint32_t other, double stiffness) {
        cpu::ContactRow<double> row;
        row.attachment = 0;
        row.object = object;
        row.other = other;
        row.stiffness = stiffness;
        row.gap = row.limit = std::numeric_limits<double>::max();
        return row;
    }
    // Each node of a side of `other` to the nearest of the side of `object`, where they differ a little, and
    // to the next one.
    std::vector<cpu::ContactRow<double>> ties(std::uint32_t object, std::uint32_t other, double x,
                                              double stiffness) const {
        const auto side = [&](std::uint32_t o) {
            std::vector<std::uint32_t> nodes;
            const Range& range = model_->objects[o].nodes;
            for (std::uint32_t n = range.first; n < range.end(); ++n)
                if (std::abs(static_cast<double>(model_->positions[n].x) - x) < 0.02) nodes.push_back(n);
            return nodes;
        };
        std::vector<cpu::ContactRow<double>> rows;
        for (const std::uint32_t n : side(other)) {
            std::vector<std::uint32_t> leaders = side(object);
            const auto distance = [&](std::uint32_t m) {
                return glm::distance(glm::vec3(model_->positions[n]), glm::vec3(model_->positions[m]));
            };
            std::sort(leaders.begin(), leaders.end(),
                      [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
            cpu::ContactRow<double> row = tie(object, other, stiffness);
            row.count = 3;
            row.nodes = {n, leaders[0], leaders[1]};
            row.weights = {1.0, -0.7, -0.3};
            rows.push_back(row);
        }
        return rows;
    }

    struct Solved {
        std::vector<glm::dvec3> displacements;
        int iterations;
        double widest;  // slip [m]
    };
    Solved solve(const std::vector<cpu::ContactRow<double>>& rows) const {
        cpu::StepSystem<double> system(model_);
        const std::vector<glm::dvec4> positions = test::converted<double>(model_->positions);
        system.inertia = inertia_;
        const std::vector<glm::dvec3> pushes = test::random_field<double>(model_->node_count(), 1);
        for (std::size_t n = 0; n < pushes.size(); ++n) system.loads[n] = 1e-3 * inertia_[n] * pushes[n];
        system.rows = rows;
        system.iterations = 1000;
        system.elastic.linearise(positions, test::converted<double>(model_->velocities), kInverseLength);
        system.enough.assign(system.enough.size(), 1e-12);
        system.rigid.begin(positions, system.inertia);
        system.solve(std::vector<std::uint32_t>(3, 0));
        Solved solved{system.displacements, system.counts.iterations, 0.0};
        for (const glm::dvec3& slip : system.slips())
            solved.widest = std::max(solved.widest, glm::length(slip));
        return solved;
    }

    static constexpr glm::ivec3 kCells{4, 4, 4};
    std::shared_ptr<const Model> model_;
    std::vector<double> inertia_;
};

// Else it takes more the stiffer they are, by the root of that.
TEST_F(GluedNodesTest, StiffTiesTakeNoMoreIterations) {
    const auto glued = [&](double stiffness) {
        std::vector<cpu::ContactRow<double>> rows = ties(0, 1, 0.3, stiffness);
        for (const cpu::ContactRow<double>& row : ties(1, 2, 0.6, stiffness)) rows.push_back(row);
        return solve(rows);
    };
    const Solved soft = glued(1e4), stiff = glued(1e8);
    EXPECT_GT(soft.iterations, 5);
    EXPECT_LT(stiff.iterations, 1.5 * soft.iterations);
    EXPECT_LT(stiff.widest, 1e-3 * soft.widest);
}

// Of two ties of a node the first one glues it, and what carries a glued node is not glued itself; whatever
// is found, the solution is the same.
TEST_F(GluedNodesTest, NothingThatCarriesOthersIsGlued) {
    std::vector<cpu::ContactRow<double>> rows = ties(0, 1, 0.3, 1e5), back = ties(1, 0, 0.3, 1e5);
    const std::size_t first = rows.size();
    rows.insert(rows.end(), back.begin(), back.end());
    rows.push_back(rows[0]);
    cpu::GluedNodes<double> glued(model_);
    glued.find(rows, inertia_);
    for (std::size_t r = 0; r < rows.size(); ++r)
        EXPECT_EQ(glued.node_of(r), r < first ? rows[r].nodes[0] : kNoNode) << r;
    EXPECT_EQ(glued.row_of(rows[0].nodes[0]), 0u);
    std::vector<double> held = inertia_;
    held[rows[0].nodes[0]] = 0.0;
    glued.find(rows, held);
    EXPECT_EQ(glued.node_of(0), kNoNode);
    glued.find({}, inertia_);
    EXPECT_TRUE(glued.is_empty());

    const Solved once = solve(rows);
    std::reverse(rows.begin(), rows.end());
    const Solved reversed = solve(rows);
    double largest = 0.0, difference = 0.0;
    for (std::size_t n = 0; n < once.displacements.size(); ++n) {
        largest = std::max(largest, glm::length(once.displacements[n]));
        difference = std::max(difference, glm::distance(once.displacements[n], reversed.displacements[n]));
    }
    EXPECT_LT(difference, 1e-2 * largest);
}

}  // namespace
}  // namespace gelatin
