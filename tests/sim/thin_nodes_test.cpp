#include "sim/thin_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "support/test_models.h"

namespace gelatin {
namespace {

float distance_between(const Model& model, std::uint32_t a, std::uint32_t b) {
    return glm::distance(glm::vec3(model.positions[a]), glm::vec3(model.positions[b]));
}

TEST(ThinNodes, AreEvenlySpacedOverTheSurface) {
    const Model model = test::make_model(test::make_body(test::make_block({20, 20, 10}, {2.0, 2.0, 1.0})));
    const std::vector<std::uint32_t> nodes = thin_surface_nodes(model, 100);
    EXPECT_GT(nodes.size(), 40u);
    EXPECT_LT(nodes.size(), 150u);
    const auto nearest = [&](std::uint32_t node) {
        float least = std::numeric_limits<float>::max();
        for (const std::uint32_t other : nodes)
            if (other != node) least = std::min(least, distance_between(model, node, other));
        return least;
    };
    const float spacing = std::sqrt(1.4f * 16.0f / 100.0f);  // of a surface of 16 m^2
    for (const std::uint32_t node : model.surface_parts.nodes) {
        const bool is_kept = std::count(nodes.begin(), nodes.end(), node) == 1;
        EXPECT_EQ(is_kept, nearest(node) >= 0.999f * spacing) << node;
    }
}

TEST(ThinNodes, EachBodyHasOneAndFewAreAllKept) {
    std::vector<Body> bodies;
    for (int b = 0; b < 5; ++b)
        bodies.push_back(test::make_body(test::make_block({2, 2, 2}, {0.1, 0.1, 0.1})));
    const Model model = pack_bodies(bodies, {}, glm::dvec3(0.0));
    const std::vector<std::uint32_t> few = thin_surface_nodes(model, 1),
                                     all = thin_surface_nodes(model, 100000);
    ASSERT_EQ(few.size(), 5u);
    for (std::size_t b = 0; b < 5; ++b) {
        EXPECT_GE(few[b], model.objects[b].nodes.first);
        EXPECT_LT(few[b], model.objects[b].nodes.end());
    }
    EXPECT_EQ(all.size(), model.surface_parts.nodes.size());
}

}  // namespace
}  // namespace gelatin
