#include "cpu/spring_terms.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

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
    const cpu::SpringRows<float> in_float{rows, model.positions.data(), starts.data(), inverse_step};
    const cpu::SpringRows<double> in_double{rows, positions_d.data(), starts_d.data(),
                                            static_cast<double>(inverse_step)};
    float largest = 0.0f;
    for (const Spring& s : model.springs) largest = std::max(largest, s.stiffness);
    int looked_at = 0;
    for (std::uint32_t slice = 0; slice < rows.nodes.size() / HalfSprings::kSlice; ++slice) {
        std::array<cpu::NodeTerms<float>, HalfSprings::kSlice> actual;
        std::array<cpu::NodeTerms<double>, HalfSprings::kSlice> expected;
        cpu::gather_spring_terms_simd(in_float, slice, actual.data());
        cpu::gather_spring_terms(in_double, slice, expected.data());
        for (std::uint32_t row = 0; row < HalfSprings::kSlice; ++row) {
            if (rows.nodes[slice * HalfSprings::kSlice + row] == kNoNode) continue;
            ++looked_at;
            // Positions of some metres, to rounding; a node has some forty springs.
            const double bound = 40 * 1e-5 * static_cast<double>(largest);
            EXPECT_LT(glm::distance(glm::dvec3(actual[row].force), expected[row].force), bound);
            EXPECT_LT(glm::distance(glm::dvec3(actual[row].hessian.diagonal), expected[row].hessian.diagonal),
                      bound);
            EXPECT_LT(glm::distance(glm::dvec3(actual[row].hessian.beside), expected[row].hessian.beside),
                      bound);
        }
    }
    EXPECT_EQ(looked_at, static_cast<int>(model.node_count()));
}

}  // namespace
}  // namespace gelatin
