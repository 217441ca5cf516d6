#include "cpu/collision/nearest_points.h"

#include <gtest/gtest.h>

#include "support/moving_pairs.h"

namespace gelatin {
namespace {

using test::PairOf;

template <class Real>
class NearestPoints : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(NearestPoints, Precisions);

TYPED_TEST(NearestPoints, OfANodeAndAFace) {
    using Vec = cpu::Vec3<TypeParam>;
    const std::array<Vec, 3> face{Vec{0, 0, 0}, Vec{4, 0, 0}, Vec{0, 4, 0}};
    const auto nearest = [&](Vec p) { return cpu::nearest_points(p, face); };
    EXPECT_EQ(nearest({1, 2, 3}).weights, Vec(0.25, 0.25, 0.5)) << "above";
    EXPECT_EQ(nearest({1, 2, 3}).apart, Vec(0, 0, -3));
    EXPECT_EQ(nearest({1, 2, 3}).squared_distance, TypeParam(9));
    EXPECT_EQ(nearest({1, -2, 3}).apart, Vec(0, 2, -3)) << "beside an edge";
    EXPECT_EQ(nearest({1, -2, 3}).weights, Vec(0.75, 0.25, 0));
    EXPECT_EQ(nearest({3, 3, 0}).weights, Vec(0, 0.5, 0.5)) << "beside the long edge";
    EXPECT_EQ(nearest({5, -1, 1}).weights, Vec(0, 1, 0)) << "at a corner";
    EXPECT_EQ(nearest({1, 1, 0}).squared_distance, TypeParam(0)) << "on it";
}

TYPED_TEST(NearestPoints, OfTwoEdges) {
    using Vec = cpu::Vec3<TypeParam>;
    const std::array<Vec, 2> edge{Vec{0, 0, 0}, Vec{4, 0, 0}};
    const auto nearest = [&](Vec c, Vec d) { return cpu::nearest_points<TypeParam>(edge, {c, d}); };
    EXPECT_EQ(nearest({1, -1, 2}, {1, 3, 2}).apart, Vec(0, 0, 2)) << "crossing";
    EXPECT_EQ(nearest({1, -1, 2}, {1, 3, 2}).fraction, TypeParam(0.25));
    EXPECT_EQ(nearest({1, -1, 2}, {1, 3, 2}).other_fraction, TypeParam(0.25));
    EXPECT_EQ(nearest({1, 1, 2}, {1, 3, 2}).apart, Vec(0, 1, 2)) << "an end over the edge";
    EXPECT_EQ(nearest({6, 1, 2}, {7, 3, 2}).apart, Vec(2, 1, 2)) << "two ends";
    EXPECT_EQ(nearest({-1, 3, 0}, {1, 3, 0}).squared_distance, TypeParam(9)) << "parallel";
    EXPECT_EQ(nearest({5, 0, 0}, {7, 0, 0}).apart, Vec(1, 0, 0)) << "on one line";
    EXPECT_EQ(nearest({2, 0, 0}, {7, 0, 0}).squared_distance, TypeParam(0)) << "one on the other";
}

TYPED_TEST(NearestPoints, OfWhatIsDegenerate) {
    using Vec = cpu::Vec3<TypeParam>;
    using Face = std::array<Vec, 3>;
    using Edge = std::array<Vec, 2>;
    const Vec p{1, 2, 0};
    EXPECT_EQ(cpu::nearest_points(p, Face{Vec(0), Vec(0), Vec(0)}).squared_distance, TypeParam(5))
        << "a point";
    EXPECT_EQ(cpu::nearest_points(p, Face{Vec(0), Vec(4, 0, 0), Vec(2, 0, 0)}).apart, Vec(0, -2, 0))
        << "a segment";
    EXPECT_EQ(cpu::nearest_points(Edge{p, p}, Edge{Vec(0), Vec(0)}).apart, -p) << "points";
    EXPECT_EQ(cpu::nearest_points(Edge{p, p}, Edge{Vec(0), Vec(4, 0, 0)}).other_fraction, TypeParam(0.25));
}

// The distance is the reference's; the weights lead to it; a short vector keeps its direction.
template <class Real>
void compare_with_reference(PairOf what, const std::vector<test::MovingPair<Real>>& pairs) {
    constexpr double kEps = std::numeric_limits<Real>::epsilon();
    double worst_distance = 0.0, worst_point = 0.0;
    for (const auto& pair : pairs) {
        const auto &a = pair.a.start, &b = pair.b.start;
        const double size = test::extent(pair), expected = test::distance_at(pair, 0.0);
        cpu::Vec3<Real> apart;
        glm::dvec3 from(a[0]), to(0.0);
        if (what == PairOf::node_and_face) {
            const auto nearest = cpu::nearest_points(a[0], b);
            apart = nearest.apart;
            for (int k = 0; k < 3; ++k) to += double(nearest.weights[k]) * glm::dvec3(b[k]);
        } else {
            const auto nearest = cpu::nearest_points<Real>({a[0], a[1]}, {b[0], b[1]});
            apart = nearest.apart;
            from = glm::mix(glm::dvec3(a[0]), glm::dvec3(a[1]), double(nearest.fraction));
            to = glm::mix(glm::dvec3(b[0]), glm::dvec3(b[1]), double(nearest.other_fraction));
        }
        const double distance = glm::length(glm::dvec3(apart));
        worst_distance = std::max(worst_distance, std::abs(distance - expected) / (kEps * size));
        worst_point = std::max(worst_point, glm::distance(glm::dvec3(apart), to - from) /
                                                (kEps * size + 4e-16 * glm::length(from)));
    }
    // Normals whose sine is just above the root of kParallel turn the vector by some thousand eps, and leave
    // more open where along two nearly parallel edges it starts and ends.
    const double loss = 1.0 / std::sqrt(static_cast<double>(cpu::kParallel<Real>));
    EXPECT_LT(worst_distance, 2.0 * loss);
    EXPECT_LT(worst_point, 64.0 * loss);
}

template <class Real>
void compare_with_reference(std::size_t count, unsigned seed) {
    for (const PairOf what : {PairOf::node_and_face, PairOf::edges}) {
        compare_with_reference(what, test::random_moving_pairs<Real>(what, count, seed));
        for (auto pairs : {test::touching_pairs<Real>(what, count, seed + 1),
                           test::nearly_touching_pairs<Real>(what, count, seed + 2)}) {
            std::erase_if(pairs, [](const auto& pair) { return test::extent(pair) == 0.0; });
            compare_with_reference(what, pairs);
        }
    }
}

TYPED_TEST(NearestPoints, AreThoseOfTheReference) {
    compare_with_reference<TypeParam>(20'000, 1);
}

template <class Real>
class NearestPointsHeavy : public ::testing::Test {};
TYPED_TEST_SUITE(NearestPointsHeavy, Precisions);

// A million of either kind and more.
TYPED_TEST(NearestPointsHeavy, AreThoseOfTheReference) {
    for (unsigned seed = 10; seed < 14; ++seed) compare_with_reference<TypeParam>(100'000, 10 * seed);
}

}  // namespace
}  // namespace gelatin
