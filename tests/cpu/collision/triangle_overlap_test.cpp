#include "cpu/collision/triangle_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>

#include "exact/triangle_overlap.h"
#include "support/triangle_pairs.h"

namespace gelatin {
namespace {

using cpu::Triangle;
using test::PairKind;
using test::TrianglePair;

template <class Real>
class TriangleOverlap : public ::testing::Test {
protected:
    // Every case represents all orders of the vertices and of the triangles.
    static bool overlap(Triangle<Real> s, Triangle<Real> t) {
        const bool result = cpu::triangles_overlap<Real>(s, t);
        constexpr int kSwaps[] = {0, 1, 0, 1, 0, 1};  // of vertices k and k + 1: all six orders, and back
        for (const int k : kSwaps) {
            std::swap(s[k], s[k + 1]);
            for (const int m : kSwaps) {
                std::swap(t[m], t[m + 1]);
                EXPECT_EQ(cpu::triangles_overlap<Real>(s, t), result);
                EXPECT_EQ(cpu::triangles_overlap<Real>(t, s), result);
            }
        }
        return result;
    }
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TriangleOverlap, Precisions);

TYPED_TEST(TriangleOverlap, CrossingAndApart) {
    const Triangle<TypeParam> flat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, -1}, {1, 1, 1}, {5, 5, 1}}})) << "an edge through the face";
    EXPECT_TRUE(this->overlap(flat, {{{-1, 1, -1}, {5, 1, -1}, {2, 1, 9}}})) << "two edges through the other";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, -1}, {3, 3, 1}, {5, 5, 1}}})) << "past the long edge";
    EXPECT_FALSE(this->overlap(flat, {{{1, 1, 1}, {2, 1, 2}, {1, 2, 3}}})) << "above";
    EXPECT_FALSE(this->overlap(flat, {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}})) << "parallel";
}

TYPED_TEST(TriangleOverlap, TouchingIsOverlap) {
    const Triangle<TypeParam> flat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, 0}, {2, 1, 2}, {1, 2, 3}}})) << "a vertex on the face";
    EXPECT_TRUE(this->overlap(flat, {{{2, 0, 0}, {2, -1, 2}, {1, -2, 3}}})) << "a vertex on an edge";
    EXPECT_TRUE(this->overlap(flat, {{{4, 0, 0}, {5, 0, 2}, {5, 2, 3}}})) << "a vertex on a vertex";
    EXPECT_TRUE(this->overlap(flat, {{{2, 0, -1}, {2, 0, 1}, {2, -3, 0}}})) << "an edge on an edge";
    EXPECT_TRUE(this->overlap(flat, {{{4, 0, 0}, {0, 4, 0}, {4, 4, 4}}})) << "a common edge";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, 0}, {5, 0, 2}, {5, 2, 3}}})) << "a vertex in the plane";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, 0}, {4, 2, 0}, {5, 5, 3}}})) << "an edge in the plane";
}

TYPED_TEST(TriangleOverlap, InOnePlane) {
    const Triangle<TypeParam> flat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    EXPECT_TRUE(this->overlap(flat, flat));
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}}})) << "one in the other";
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, 0}, {5, 5, 0}, {5, 4, 0}}})) << "partly";
    EXPECT_TRUE(this->overlap(flat, {{{2, 2, 0}, {5, 5, 0}, {5, 4, 0}}})) << "a vertex on an edge";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, 0}, {5, 5, 0}, {5, 4, 0}}}));
    const Triangle<TypeParam> steep = {{{0, 0, 0}, {1, 2, 3}, {3, 2, 1}}};
    EXPECT_TRUE(this->overlap(steep, {{{2, 2, 2}, {4, 4, 4}, {5, 4, 3}}}));
    EXPECT_FALSE(this->overlap(steep, {{{3, 3, 3}, {4, 4, 4}, {5, 4, 3}}}));
}

TYPED_TEST(TriangleOverlap, SegmentsAndPoints) {
    const Triangle<TypeParam> flat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, -1}, {1, 1, 1}, {1, 1, 1}}})) << "a segment through the face";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, -1}, {3, 3, 1}, {3, 3, 0}}})) << "a segment beside it";
    EXPECT_TRUE(this->overlap(flat, {{{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}})) << "a point on it";
    EXPECT_FALSE(this->overlap(flat, {{{3, 3, 0}, {3, 3, 0}, {3, 3, 0}}})) << "a point in its plane";
    const Triangle<TypeParam> segment = {{{1, 1, 1}, {3, 3, 3}, {2, 2, 2}}};
    EXPECT_TRUE(this->overlap(segment, {{{1, 2, 3}, {3, 2, 1}, {1, 2, 3}}})) << "segments that cross";
    EXPECT_FALSE(this->overlap(segment, {{{1, 2, 2}, {3, 2, 1}, {1, 2, 2}}})) << "skew segments";
    EXPECT_TRUE(this->overlap(segment, {{{3, 3, 3}, {4, 4, 4}, {5, 5, 5}}})) << "end to end";
    EXPECT_FALSE(this->overlap(segment, {{{4, 4, 4}, {5, 5, 5}, {4, 4, 4}}})) << "on one line, apart";
    const Triangle<TypeParam> point = {{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}};
    EXPECT_TRUE(this->overlap(segment, point));
    EXPECT_TRUE(this->overlap(point, point));
    EXPECT_FALSE(this->overlap(point, {{{2, 2, 3}, {2, 2, 3}, {2, 2, 3}}}));
}

TYPED_TEST(TriangleOverlap, WhatIsNotFiniteOverlapsNothing) {
    using Limits = std::numeric_limits<TypeParam>;
    const Triangle<TypeParam> flat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    for (const TypeParam bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
        for (int k = 0; k < 9; ++k) {
            Triangle<TypeParam> broken = {{{1, 1, -1}, {1, 1, 1}, {5, 5, 1}}};
            broken[k / 3][k % 3] = bad;
            EXPECT_FALSE(this->overlap(flat, broken));
        }
    }
}

TYPED_TEST(TriangleOverlap, OrderChangesNothing) {
    for (const auto& [kind, name] : test::kPairKinds) {
        SCOPED_TRACE(name);
        for (const auto& pair : test::degenerate_pairs<TypeParam>(kind, 500, 21))
            this->overlap(pair.s, pair.t);
    }
}

// Products that underflow or overflow in float change nothing.
TYPED_TEST(TriangleOverlap, SizeChangesNothing) {
    auto pairs = test::random_pairs<TypeParam>(2000, 5);
    for (const PairKind kind : {PairKind::shared_edge, PairKind::coplanar, PairKind::collinear}) {
        for (const auto& pair : test::degenerate_pairs<TypeParam>(kind, 2000, 6)) pairs.push_back(pair);
    }
    for (const int exponent : {-40, 70}) {
        const auto others = test::scaled(pairs, exponent);
        for (std::size_t n = 0; n < pairs.size(); ++n) {
            EXPECT_EQ(cpu::triangles_overlap<TypeParam>(others[n].s, others[n].t),
                      cpu::triangles_overlap<TypeParam>(pairs[n].s, pairs[n].t));
        }
    }
}

double extent(const Triangle<double>& s, const Triangle<double>& t) {
    glm::dvec3 low = s[0], high = s[0];
    for (const auto& triangle : {s, t}) {
        for (const glm::dvec3& p : triangle) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

// No overlap is missed, and only what is as near as the root of double's rounding bound may count as touching
// without being in touch. Returns how often that was.
template <class Real>
std::size_t compare_with_exact_arithmetic(const std::vector<TrianglePair<Real>>& pairs) {
    const double nearness = std::sqrt(cpu::overlap::kRoundingBound<double>);
    std::size_t misses = 0, false_alarms = 0;
    for (const auto& pair : pairs) {
        const auto s = cpu::overlap::to_double(pair.s), t = cpu::overlap::to_double(pair.t);
        const bool actual = cpu::triangles_overlap<Real>(pair.s, pair.t),
                   expected = test::exactly_overlap(s, t);
        misses += expected && !actual;
        if (actual && !expected) {
            ++false_alarms;
            EXPECT_LE(test::distance_apart(s, t), nearness * extent(s, t));
        }
    }
    EXPECT_EQ(misses, 0u);
    return false_alarms;
}

// Pairs whose vertices were rounded to float are decided exactly, but for slivers as thin as that rounding.
void compare_all_kinds(std::size_t count) {
    for (const auto& [kind, name] : test::kPairKinds) {
        SCOPED_TRACE(name);
        const bool has_slivers = kind == PairKind::shared_edge || kind == PairKind::sliver ||
                                 kind == PairKind::collinear || kind == PairKind::integer_grid;
        EXPECT_LE(compare_with_exact_arithmetic(test::degenerate_pairs<float>(kind, count, 2)),
                  has_slivers ? count / 100 : 0);
        compare_with_exact_arithmetic(test::degenerate_pairs<double>(kind, count, 3));
    }
}

TEST(TriangleOverlapAgainstExactArithmetic, RandomPairs) {
    EXPECT_EQ(compare_with_exact_arithmetic(test::random_pairs<float>(20'000, 1)), 0u);
    EXPECT_EQ(compare_with_exact_arithmetic(test::random_pairs<double>(20'000, 2)), 0u);
}

TEST(TriangleOverlapAgainstExactArithmetic, DegeneratePairs) {
    compare_all_kinds(1000);
}

TEST(TriangleOverlapHeavy, RandomPairs) {
    EXPECT_EQ(compare_with_exact_arithmetic(test::random_pairs<float>(1'000'000, 3)), 0u);
    EXPECT_EQ(compare_with_exact_arithmetic(test::random_pairs<double>(200'000, 4)), 0u);
}

TEST(TriangleOverlapHeavy, DegeneratePairs) {
    compare_all_kinds(10'000);
}

}  // namespace
}  // namespace gelatin
