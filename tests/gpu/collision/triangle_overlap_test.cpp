// shaders/sim/collision/triangle_overlap.glsl decides every pair as its CPU twin does, bit for bit.
#include "cpu/collision/triangle_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "gl/buffer.h"
#include "gl/program.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"
#include "support/source_path.h"
#include "support/triangle_pairs.h"

namespace gelatin {
namespace {

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

struct Change {
    const char* name = "none";
    std::string from, to;
};

std::string changed_include(const Change& change) {
    std::string text = read_file(test::source_path("shaders/sim/collision/triangle_overlap.glsl"));
    const std::size_t at = text.find(change.from);
    EXPECT_NE(at, std::string::npos) << "the shader no longer has: " << change.from;
    return at == std::string::npos ? text : text.replace(at, change.from.size(), change.to);
}

std::vector<std::uint32_t> overlaps_on_gpu(const Pairs& pairs, const Change& change = {}) {
    test::ShaderFolder folder;
    folder.add("probe.comp", kProbe);
    for (const std::string file :
         {"include/global_index.glsl", "layouts/predicates.glsl", "sim/collision/rounding.glsl"})
        folder.add(file, read_file(test::source_path("shaders/" + file)));
    folder.add("sim/collision/triangle_overlap.glsl", changed_include(change));
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

std::size_t difference_count(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    std::size_t count = 0;
    for (std::size_t n = 0; n < a.size(); ++n) count += a[n] != b[n];
    return count;
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

class TriangleOverlapTest : public test::GlTest {
protected:
    static void expect_equal_to_cpu(const Pairs& pairs) {
        EXPECT_EQ(difference_count(overlaps_on_gpu(pairs), overlaps_on_cpu(pairs)), 0u);
    }
};

TEST_F(TriangleOverlapTest, RandomPairs) {
    const Pairs pairs = test::random_pairs<float>(20'001, 30);
    ASSERT_NE(pairs.size() % 64, 0u);
    expect_equal_to_cpu(pairs);
}

TEST_F(TriangleOverlapTest, DegeneratePairsInAnyOrder) {
    expect_equal_to_cpu(and_in_other_orders(pairs_of_all_kinds(500)));
}

// Drivers may flush to zero what is subnormal in float.
TEST_F(TriangleOverlapTest, ProductsThatUnderflowOrOverflow) {
    Pairs pairs = pairs_of_all_kinds(100);
    for (const auto& pair : test::random_pairs<float>(2000, 32)) pairs.push_back(pair);
    for (const int exponent : {-45, -40, 70}) expect_equal_to_cpu(test::scaled(pairs, exponent));
}

TEST_F(TriangleOverlapTest, WhatIsNotFiniteOverlapsNothing) {
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
    EXPECT_EQ(overlaps_on_gpu(pairs), expected);
}

class TriangleOverlapHeavyTest : public TriangleOverlapTest {};

TEST_F(TriangleOverlapHeavyTest, RandomPairs) {
    expect_equal_to_cpu(test::random_pairs<float>(150'000, 33));
}

TEST_F(TriangleOverlapHeavyTest, DegeneratePairsInAnyOrder) {
    expect_equal_to_cpu(and_in_other_orders(pairs_of_all_kinds(5000)));
}

// Broken in these ways, the shader is told from its twin.
const Change kMutants[] = {
    {"the_order_of_vertices_matters", "comes_before(b, a)", "false"},
    {"float_is_trusted", "9.5367432e-7", "0.0"},
    {"float_is_not_settled_in_double", "rest = zero_signs(signs)", "rest = 0u"},
    {"double_is_trusted", "1.7763568394002505e-15lf", "0.0lf"},
    {"underflow_is_forgotten", "1.5777218e-30", "0.0"},
    {"an_edge_is_forgotten", "open_edges |= 8u << i;", ""},
    {"turns_are_shifted", "turns = kEdgeOfT << i", "turns = kEdgeOfT << (i + 1)"},
    {"projections_are_not_asked", "line < 4", "line < 0"},
    {"a_line_is_not_asked", "line < 4", "line < 3"},
    {"boxes_are_not_asked", "bool misses = ", "bool misses = false && "},
    {"own_corner_is_ignored", "outer * (outer - own)", "3 * abs(outer)"},
    {"nan_is_taken", "uvec3(0x7f800000u)", "uvec3(0u, 0u, 0u) - 1u"},
};
class TriangleOverlapMutantsTest : public test::GlTest, public ::testing::WithParamInterface<Change> {};
INSTANTIATE_TEST_SUITE_P(All, TriangleOverlapMutantsTest, ::testing::ValuesIn(kMutants),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(TriangleOverlapMutantsTest, IsCaught) {
    Pairs pairs = and_in_other_orders(pairs_of_all_kinds(3000));
    for (const auto& pair : test::scaled(pairs_of_all_kinds(500), -20)) pairs.push_back(pair);
    pairs.push_back(pairs.front());
    pairs.back().s[1].y = std::numeric_limits<float>::quiet_NaN();
    const std::vector<std::uint32_t> expected = overlaps_on_cpu(pairs);
    ASSERT_EQ(difference_count(overlaps_on_gpu(pairs), expected), 0u);
    EXPECT_GT(difference_count(overlaps_on_gpu(pairs, GetParam()), expected), 0u);
}

}  // namespace
}  // namespace gelatin
