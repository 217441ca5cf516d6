#include "cpu/contact/partial_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "support/contact_scenes.h"

namespace gelatin {
namespace {

// A block, and where a motion that turns it leads.
struct Turn {
    std::shared_ptr<const Model> model = test::make_blocks({{}, {.place = {1, 0.2, 0}}});
    std::vector<glm::dvec4> starts{model->positions.begin(), model->positions.end()}, ends = starts;

    explicit Turn(double angle) {
        for (glm::dvec4& p : ends)
            p = {0.3 + std::cos(angle) * p.x - std::sin(angle) * p.y,
                 std::sin(angle) * p.x + std::cos(angle) * p.y, p.z - 0.1, p.w};
    }
};

TEST(PartialTurn, KeepsABodyInShapeWhereItHasMadeThePart) {
    Turn turn(0.8);
    const std::vector<glm::dvec4> before = turn.ends;
    const Range& nodes = turn.model->objects[1].nodes;
    const double part = 0.3;
    const auto mean = [&](const std::vector<glm::dvec4>& at) {
        glm::dvec3 sum(0.0);
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            sum += static_cast<double>(turn.model->masses[n]) * glm::dvec3(at[n]);
        return sum;
    };
    ASSERT_TRUE(cpu::turn_in_part<double>(*turn.model, 1, part, turn.starts, turn.ends));
    EXPECT_LT(glm::length(mean(turn.ends) - mean(before)), 1e-12);  // with its momentum
    const auto made = [&](const std::vector<glm::dvec4>& at, std::uint32_t n) {
        return glm::dvec3(turn.starts[n]) + part * glm::dvec3(at[n] - turn.starts[n]);
    };
    double most = 0.0;
    for (std::uint32_t a = nodes.first; a < nodes.end(); ++a)
        for (std::uint32_t b = a + 1; b < nodes.end(); ++b) {
            const double length = glm::length(glm::dvec3(turn.starts[a] - turn.starts[b]));
            EXPECT_NEAR(glm::length(made(turn.ends, a) - made(turn.ends, b)), length, 1e-9);
            most = std::max(most, length - glm::length(made(before, a) - made(before, b)));
        }
    EXPECT_GT(most, 0.01);                                                               // as it was
    for (std::uint32_t n = 0; n < nodes.first; ++n) EXPECT_EQ(turn.ends[n], before[n]);  // another body
}

TEST(PartialTurn, LeavesWhatHardlyTurns) {
    Turn turn(0.01);
    const std::vector<glm::dvec4> before = turn.ends;
    EXPECT_FALSE(cpu::turn_in_part<double>(*turn.model, 1, 0.5, turn.starts, turn.ends));
    EXPECT_TRUE(turn.ends == before);
}

}  // namespace
}  // namespace gelatin
