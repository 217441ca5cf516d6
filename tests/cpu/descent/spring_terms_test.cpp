#include "cpu/descent/spring_terms.h"

#include <gtest/gtest.h>

#include <random>

#include "cpu/descent/descend_groups.h"
#include "cpu/descent/spring_blocks.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

// SIMD against the plain sum in double: wrong lanes, tails or transposes would be off by far more than
// rounding. Some nodes lie in one place.
TEST(SpringTerms, WithSimdAreThePlainOnes) {
    Model model = test::make_lively_model();
    for (std::uint32_t n = 10; n < 40; ++n)
        model.positions[n] = glm::vec4(glm::vec3(model.positions[10]), model.positions[n].w);
    const DescentRows rows = make_descent_rows(model);
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<glm::vec4> starts;
    for (const glm::vec4& p : model.positions) {
        const float x = normal(random), y = normal(random), z = normal(random);
        starts.push_back(p + 0.01f * glm::vec4(x, y, z, 0.0f));
        starts.back().w = 2e-3f;
    }
    const std::vector<glm::dvec4> positions_d(model.positions.begin(), model.positions.end()),
        starts_d(starts.begin(), starts.end());
    const float inverse_step = 60.0f;
    const cpu::SpringRows<double> in_double{rows, positions_d.data(), starts_d.data(),
                                            static_cast<double>(inverse_step)};
    const cpu::SpringBlocks springs = cpu::make_spring_blocks(rows);
    cpu::SpringBlocks damped = springs;
    cpu::damp_springs(springs, rows.nodes, starts.data(), inverse_step, damped);
    const std::vector<glm::vec4> held(model.node_count(),
                                      glm::vec4(0.0f));  // nothing but springs, and no step
    const cpu::TetBlocks no_tets;
    const cpu::DescentGroups groups{damped, {no_tets, {}, {}, 0.0f}, rows.nodes, held, {}};
    float largest = 0.0f;
    for (const Spring& s : model.springs) largest = std::max(largest, s.stiffness);
    int looked_at = 0;
    for (std::uint32_t group = 0; group < rows.nodes.size() / cpu::kGroup; ++group) {
        cpu::TermColumns columns;
        EXPECT_EQ(cpu::descend_group(groups, group, columns, model.positions), 0u);
        for (std::uint32_t row = 0; row < cpu::kGroup; ++row) {
            const std::uint32_t node = rows.nodes[group * cpu::kGroup + row];
            if (node == kNoNode) continue;
            ++looked_at;
            const cpu::NodeTerms<float> actual = columns.row(row);
            cpu::NodeTerms<double> expected;
            cpu::add_row_springs(in_double, group * cpu::kGroup + row, expected);
            // Positions of some metres, to rounding; a node has some forty springs.
            const double bound = 40 * 1e-5 * static_cast<double>(largest);
            EXPECT_LT(glm::distance(glm::dvec3(actual.force), expected.force), bound);
            EXPECT_LT(glm::distance(glm::dvec3(actual.hessian.diagonal), expected.hessian.diagonal), bound);
            EXPECT_LT(glm::distance(glm::dvec3(actual.hessian.beside), expected.hessian.beside), bound);
            EXPECT_EQ(glm::dvec4(model.positions[node]), positions_d[node]) << "a held node has moved";
        }
    }
    EXPECT_EQ(looked_at, static_cast<int>(model.node_count()));
}

}  // namespace
}  // namespace gelatin
