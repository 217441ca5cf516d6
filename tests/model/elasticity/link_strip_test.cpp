#include "model/elasticity/link_strip.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/elasticity/node_tets.h"
#include "support/test_models.h"

namespace gelatin {
namespace {

bool is_rotation_of(const LinkTriangle& a, const LinkTriangle& b) {
    for (std::size_t shift = 0; shift < 3; ++shift) {
        if (a == LinkTriangle{b[shift], b[(shift + 1) % 3], b[(shift + 2) % 3]}) return true;
    }
    return false;
}

// Follows the strip as its users do. @return the number of its steps
std::size_t expect_each_triangle_once(std::span<const LinkTriangle> triangles) {
    const std::vector<StripStep> steps = make_link_strip(triangles);
    std::vector<int> seen(triangles.size(), 0);
    LinkTriangle last{};
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const StripStep& step = steps[k];
        last = {step.keeps_oldest ? last[0] : last[1], last[2], step.vertex};
        if (step.triangle == StripStep::kNoTriangle) continue;
        EXPECT_GE(k, 2u) << "two vertices come in first";
        ++seen[step.triangle];
        const LinkTriangle upright = step.is_reversed ? LinkTriangle{last[1], last[0], last[2]} : last;
        EXPECT_TRUE(is_rotation_of(upright, triangles[step.triangle])) << "step " << k;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(triangles.size()));
    return steps.size();
}

// Round the nodes of a mesh nearly all are one strip.
TEST(LinkStrip, HasEachTetRoundANodeOnce) {
    const TetMesh mesh = test::make_block({6, 5, 5}, {0.6, 0.5, 0.5}, 0.2);
    const NodeTets tets = make_node_tets(static_cast<std::uint32_t>(mesh.positions.size()), mesh.tets);
    std::size_t steps = 0, triangle_count = 0, nodes = 0;
    for (std::uint32_t n = 0; n < mesh.positions.size(); ++n) {
        std::vector<LinkTriangle> triangles;
        for (std::uint32_t e = tets.starts[n]; e < tets.starts[n + 1]; ++e) {
            const auto& opposite = kOppositeCorners[tets.entries[e] % 4];
            const glm::uvec4& tet = mesh.tets[tets.entries[e] / 4];
            triangles.push_back({tet[opposite[0]], tet[opposite[1]], tet[opposite[2]]});
        }
        steps += expect_each_triangle_once(triangles);
        triangle_count += triangles.size();
        ++nodes;
    }
    EXPECT_LT(static_cast<double>(steps), 1.02 * static_cast<double>(triangle_count + 2 * nodes));
}

TEST(LinkStrip, BeginsAnewWhereTrianglesDoNotTouch) {
    const std::vector<LinkTriangle> apart{{1, 2, 3}, {4, 5, 6}, {3, 2, 7}};
    EXPECT_EQ(expect_each_triangle_once(apart), 4u + 3u);
    const std::vector<LinkTriangle> at_a_corner{{1, 2, 3}, {3, 4, 5}};
    EXPECT_EQ(expect_each_triangle_once(at_a_corner), 6u);
}

// A tet that is there twice, and edges of three triangles, are no mesh, but must not be read wrong.
TEST(LinkStrip, TakesWhatIsNoSurface) {
    expect_each_triangle_once(std::vector<LinkTriangle>{{1, 2, 3}, {1, 2, 3}, {2, 1, 4}});
    expect_each_triangle_once(std::vector<LinkTriangle>{{1, 2, 3}, {2, 1, 4}, {1, 2, 5}, {5, 2, 6}});
    EXPECT_TRUE(make_link_strip({}).empty());
}

}  // namespace
}  // namespace gelatin
