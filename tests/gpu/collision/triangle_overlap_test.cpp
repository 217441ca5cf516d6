// shaders/sim/collision/triangle_overlap.glsl decides every pair as its CPU twin does, bit for bit.
#include "cpu/collision/triangle_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/shader_source.h"
#include "gpu/support/mutants.h"
#include "gpu/support/scenario.h"
#include "support/triangle_pairs.h"

namespace gelatin {
namespace {

using test::MutantsTest;
using Pairs = std::vector<test::TrianglePair<float>>;

constexpr std::uint32_t kPoison = 7;
constexpr std::size_t kGuard = 70;

constexpr const char* kProbe = R"(
#include "include/global_index.glsl"
#include "sim/collision/triangle_overlap.glsl"
layout(local_size_x = 64) in;
layout(std430) readonly buffer Corners { vec4 corners[]; };
layout(std430) writeonly buffer Overlaps { uint overlaps[]; };
uniform uint pair_count;
void main() {
    uint n = global_index();
    if (n >= pair_count) return;
    vec3 p[6];
    for (uint k = 0u; k < 6u; ++k) p[k] = corners[6u * n + k].xyz;
    overlaps[n] = uint(triangles_overlap(p[0], p[1], p[2], p[3], p[4], p[5]));
}
)";

std::vector<std::uint32_t> overlaps_on_gpu(const Pairs& pairs) {
    const gl::ShaderOverride probe("probe.comp", kProbe);
    const gl::Program program = gl::Program::compute("probe.comp");

    std::vector<glm::vec4> points;
    for (const auto& pair : pairs) {
        for (const auto* t : {&pair.s, &pair.t}) {
            for (const glm::vec3& p : *t) points.emplace_back(p, 0.0f);
        }
    }
    const gl::Buffer<glm::vec4> corners{std::span<const glm::vec4>(points)};
    std::vector<std::uint32_t> overlaps(pairs.size() + kGuard, kPoison);
    const gl::Buffer<std::uint32_t> results{std::span<const std::uint32_t>(overlaps)};
    program.bind("Corners", corners);
    program.bind("Overlaps", results);
    program.set("pair_count", static_cast<std::uint32_t>(pairs.size()));
    program.dispatch(pairs.size());
    gl::barrier(gl::Barrier::buffer_update);
    results.download(overlaps);
    return overlaps;
}

std::vector<std::uint32_t> overlaps_on_cpu(const Pairs& pairs) {
    std::vector<std::uint32_t> overlaps(pairs.size() + kGuard, kPoison);
    std::transform(pairs.begin(), pairs.end(), overlaps.begin(),
                   [](const auto& pair) { return cpu::triangles_overlap<float>(pair.s, pair.t); });
    return overlaps;
}

double cpu_disagreement(const Pairs& pairs) {
    return test::error_if(overlaps_on_gpu(pairs) != overlaps_on_cpu(pairs));
}

// The same pairs again with other orders of triangles and vertices.
Pairs and_in_other_orders(Pairs pairs) {
    const std::size_t count = pairs.size();
    for (std::size_t n = 0; n < count; ++n) {
        auto [s, t] = pairs[n];
        std::rotate(s.begin(), s.begin() + n % 3, s.end());
        std::swap(t[n % 3], t[(n + 1) % 3]);
        pairs.push_back({t, s});
    }
    return pairs;
}

Pairs pairs_of_all_kinds(std::size_t count) {
    Pairs pairs;
    for (const auto& [kind, name] : test::kPairKinds) {
        for (const auto& pair : test::degenerate_pairs<float>(kind, count, 31)) pairs.push_back(pair);
    }
    return pairs;
}

double worst_of_pairs_that_are_not_finite() {
    using Limits = std::numeric_limits<float>;
    Pairs pairs;
    for (const float bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
        for (int k = 0; k < 18; ++k) {
            test::TrianglePair<float> pair{{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}},
                                           {{{1, 1, -1}, {1, 1, 1}, {5, 5, 1}}}};
            (k < 9 ? pair.s : pair.t)[k % 9 / 3][k % 3] = bad;
            pairs.push_back(pair);
        }
    }
    std::vector<std::uint32_t> expected(pairs.size(), 0);
    expected.resize(pairs.size() + kGuard, kPoison);
    return test::error_if(overlaps_on_gpu(pairs) != expected);
}

test::Scenarios triangle_scenarios() {
    test::Scenarios scenarios{
        {"degenerate_in_any_order",
         [] { return cpu_disagreement(and_in_other_orders(pairs_of_all_kinds(3000))); }},
        {"not_finite", worst_of_pairs_that_are_not_finite},
        {"random", [] { return cpu_disagreement(test::random_pairs<float>(20'001, 30)); }}};
    // Drivers may flush to zero what is subnormal in float.
    for (const auto& [name, exponent] :
         {std::pair{"small", -20}, {"tiny", -40}, {"underflowing", -45}, {"overflowing", 70}}) {
        scenarios.push_back({name, [exponent = exponent] {
                                 Pairs pairs = pairs_of_all_kinds(500);
                                 for (const auto& pair : test::random_pairs<float>(2000, 32))
                                     pairs.push_back(pair);
                                 return cpu_disagreement(test::scaled(pairs, exponent));
                             }});
    }
    return scenarios;
}

class TriangleOverlapParityTest : public test::ParityTest {};
INSTANTIATE_TEST_SUITE_P(All, TriangleOverlapParityTest, ::testing::ValuesIn(triangle_scenarios()),
                         test::name_of_scenario);

TEST_P(TriangleOverlapParityTest, MatchesTheCpu) {
    EXPECT_LE(GetParam().error(), 1.0);
}

class TriangleOverlapHeavyTest : public test::GlTest {};

TEST_F(TriangleOverlapHeavyTest, RandomPairs) {
    EXPECT_EQ(cpu_disagreement(test::random_pairs<float>(150'000, 33)), 0.0);
}

TEST_F(TriangleOverlapHeavyTest, DegeneratePairsInAnyOrder) {
    EXPECT_EQ(cpu_disagreement(and_in_other_orders(pairs_of_all_kinds(5000))), 0.0);
}

// Broken in these ways, the shader differs from its twin.
constexpr test::Mutant kMutants[] = {
    {"the_order_of_vertices_matters", "sim/collision/triangle_overlap.glsl", "comes_before(b, a)", "false"},
    {"float_is_trusted", "sim/collision/triangle_overlap.glsl", "float(kOverlapRounding) * kEpsilon", "0.0"},
    {"float_is_not_settled_in_double", "sim/collision/triangle_overlap.glsl", "rest = zero_signs(signs)",
     "rest = 0u"},
    {"double_is_trusted", "sim/collision/triangle_overlap.glsl", "1.7763568394002505e-15lf", "0.0lf"},
    {"underflow_is_forgotten", "sim/collision/rounding.glsl", "float(kUnderflowRounding) * kLeastNormal",
     "0.0"},
    {"an_edge_is_forgotten", "sim/collision/triangle_overlap.glsl", "open_edges |= 8u << i;", ""},
    {"orientations_are_shifted", "sim/collision/triangle_overlap.glsl", "orientations = kEdgeOfT << i",
     "orientations = kEdgeOfT << (i + 1)"},
    {"projections_are_not_asked", "sim/collision/triangle_overlap.glsl", "line < 4", "line < 0"},
    {"a_line_is_not_asked", "sim/collision/triangle_overlap.glsl", "line < 4", "line < 3"},
    {"boxes_are_not_asked", "sim/collision/triangle_overlap.glsl",
     "bool misses = ", "bool misses = false && "},
    {"own_corner_is_ignored", "sim/collision/triangle_overlap.glsl", "outer * (outer - own)",
     "3 * abs(outer)"},
    {"nan_is_taken", "sim/collision/triangle_overlap.glsl", "uvec3(0x7f800000u)", "uvec3(0u, 0u, 0u) - 1u"},
};
INSTANTIATE_TEST_SUITE_P(TriangleOverlap, MutantsTest,
                         ::testing::ValuesIn(test::cases(kMutants, triangle_scenarios())),
                         test::name_of_case);

}  // namespace
}  // namespace gelatin
