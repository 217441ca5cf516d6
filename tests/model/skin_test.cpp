#include "model/skin.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/random_maker.h"

namespace gelatin {
namespace {

struct Points {
    std::vector<glm::vec4> nodes;
    std::vector<SkinPoint> points;
};

// Tets of 0.1 m around a place, with points inside and outside of them.
Points random_points(const glm::dvec3& place) {
    test::RandomMaker random(5);
    Points made;
    for (int n = 0; n < 400; ++n)
        made.nodes.emplace_back(glm::vec3(place + random.point(0.1)), static_cast<float>(n));
    for (int p = 0; p < 1000; ++p) {
        const auto node = [&] { return static_cast<std::uint32_t>(random.integer(0, 399)); };
        const glm::dvec3 w = random.point(1.5);
        made.points.push_back({node(), node(), node(), node(), glm::vec4(1.0 - w.x - w.y - w.z, w)});
    }
    return made;
}

// From the same weights, the first of which is what the others leave.
glm::dvec3 in_double(const Points& made, const SkinPoint& point) {
    const auto at = [&](std::uint32_t node) { return glm::dvec3(made.nodes[node]); };
    const glm::dvec4 w(point.weights);
    return (1.0 - w.y - w.z - w.w) * at(point.a) + w.y * at(point.b) + w.z * at(point.c) + w.w * at(point.d);
}

// 1 m off the origin, and 100 m: a rounding of the result, and some of differences of 0.2 m.
TEST(Skin, PointsAreWhereTheirWeightsSay) {
    constexpr double kEps = 6e-8;
    for (const double far : {1.0, 100.0}) {
        const Points made = random_points(glm::dvec3(far, -far, 0.5 * far));
        const std::vector<glm::vec4> at = carry_skin(made.points, std::span(made.nodes));
        ASSERT_EQ(at.size(), made.points.size());
        for (std::size_t p = 0; p < at.size(); ++p) {
            EXPECT_LT(glm::distance(glm::dvec3(at[p]), in_double(made, made.points[p])),
                      kEps * (4.0 * far + 16.0 * 1.5 * 0.35));
            EXPECT_EQ(at[p].w, 1.0f);
        }
    }
}

TEST(Skin, OtherVectorsOfNodesAreCarriedAlike) {
    const Points made = random_points(glm::dvec3(1.0));
    std::vector<float> of_nodes;
    for (const glm::vec4& p : made.nodes) of_nodes.insert(of_nodes.end(), {p.x, p.y, p.z});
    const std::vector<glm::vec4> at = carry_skin(made.points, std::span(made.nodes));
    const std::vector<float> flat = carry_skin(made.points, std::span<const float>(of_nodes));
    for (std::size_t p = 0; p < at.size(); ++p)
        EXPECT_EQ(glm::vec3(at[p]), glm::vec3(flat[3 * p], flat[3 * p + 1], flat[3 * p + 2]));
}

TEST(Skin, APointAtANodeIsExactlyThere) {
    const Points made = random_points(glm::dvec3(333.3));
    const SkinPoint point{7, 7, 7, 7, {1.0f, 0.0f, 0.0f, 0.0f}};
    EXPECT_EQ(glm::vec3(carry_skin(std::span(&point, 1), std::span(made.nodes)).front()),
              glm::vec3(made.nodes[7]));
}

}  // namespace
}  // namespace gelatin
