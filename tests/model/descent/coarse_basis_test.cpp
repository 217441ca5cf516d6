#include "model/descent/coarse_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/test_models.h"

namespace gelatin {
namespace {

Body bar(glm::dvec3 place) {
    Body body = test::make_body(test::make_block({20, 3, 3}, {2.0, 0.3, 0.3}, 0.2));
    for (glm::dvec3& p : body.mesh.positions) p += place;
    return body;
}

// A free bar, a small body, and a bar that is held at one end.
Model three_bodies() {
    Body held = bar({0.0, 2.0, 0.0});
    held.pins = {HalfSpaceRegion{{1.0, 0.0, 0.0}, 0.05}};
    return pack_bodies({bar({}), test::make_body(test::make_block({2, 2, 2}, glm::dvec3(0.2), 0.1)), held},
                       {}, {});
}

double weight_of(const CoarseBasis& basis, std::uint32_t node) {
    double sum = 0.0;
    for (const CoarseBasis::Part& part : basis.clusters_of(node)) sum += static_cast<double>(part.weight);
    return sum;
}

TEST(CoarseBasis, LeavesSmallBodiesToSweeps) {
    const CoarseBasis basis = make_coarse_basis(three_bodies());
    EXPECT_GE(basis.objects[0].count, 8u);
    EXPECT_EQ(basis.objects[1].count, 0u);
    EXPECT_EQ(basis.objects[2].first, basis.objects[0].count);
}

TEST(CoarseBasis, WeightsAreOneFarFromPinsAndNothingAtThem) {
    const Model model = three_bodies();
    const CoarseBasis basis = make_coarse_basis(model);
    const Range &free = model.objects[0].nodes, &held = model.objects[2].nodes;
    for (std::uint32_t n = free.first; n < free.end(); ++n) EXPECT_NEAR(weight_of(basis, n), 1.0, 1e-5);
    for (std::uint32_t n = held.first; n < held.end(); ++n) {
        if (model.positions[n].w == 0.0f) {
            EXPECT_EQ(weight_of(basis, n), 0.0);
        } else {
            EXPECT_GT(weight_of(basis, n), 0.1);
            EXPECT_LT(weight_of(basis, n), 1.0 + 1e-5);
            if (model.positions[n].x > 1.0f) {
                EXPECT_NEAR(weight_of(basis, n), 1.0, 1e-5);
            }
        }
    }
}

// Both tables hold the same weights, and clusters keep to their objects.
TEST(CoarseBasis, KnowsClustersOfNodesAndNodesOfClusters) {
    const Model model = three_bodies();
    const CoarseBasis basis = make_coarse_basis(model);
    EXPECT_EQ(basis.node_parts.size(), basis.cluster_parts.size());
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const Range& clusters = basis.objects[o];
        for (std::uint32_t k = clusters.first; k < clusters.end(); ++k) {
            for (const CoarseBasis::Part& part : basis.nodes_of(k)) {
                EXPECT_GE(part.index, model.objects[o].nodes.first);
                EXPECT_LT(part.index, model.objects[o].nodes.end());
                const auto of_node = basis.clusters_of(part.index);
                EXPECT_TRUE(std::any_of(of_node.begin(), of_node.end(), [&](const CoarseBasis::Part& p) {
                    return p.index == k && p.weight == part.weight;
                }));
            }
        }
    }
}

// Cores part the free nodes among them, and none is much larger than another: a bar's follow one another.
TEST(CoarseBasis, CoresShareTheNodes) {
    const Model model = three_bodies();
    const CoarseBasis basis = make_coarse_basis(model);
    std::vector<int> uses(model.node_count(), 0);
    for (const std::uint32_t n : basis.core_nodes) ++uses[n];
    for (const std::size_t o : {0, 2}) {
        const Range& nodes = model.objects[o].nodes;
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
            EXPECT_EQ(uses[n], model.positions[n].w > 0.0f ? 1 : 0);
    }
    for (std::uint32_t k = 0; k < basis.cluster_count(); ++k) {
        EXPECT_GE(basis.core_of(k).size(), 4u);
        EXPECT_LE(basis.core_of(k).size(), 60u);
        for (const std::uint32_t n : basis.core_of(k))
            EXPECT_LT(std::abs(static_cast<double>(model.positions[n].x) - basis.middles[k].x), 0.4);
    }
}

TEST(CoarseBasis, IsTheSameForTheSameModel) {
    const Model model = three_bodies();
    const CoarseBasis one = make_coarse_basis(model), two = make_coarse_basis(model);
    EXPECT_EQ(one.core_nodes, two.core_nodes);
    EXPECT_TRUE(
        std::equal(one.node_parts.begin(), one.node_parts.end(), two.node_parts.begin(), two.node_parts.end(),
                   [](const auto& a, const auto& b) { return a.index == b.index && a.weight == b.weight; }));
}

}  // namespace
}  // namespace gelatin
