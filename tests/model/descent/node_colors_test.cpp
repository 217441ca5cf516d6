#include "model/descent/node_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/test_models.h"

namespace gelatin {
namespace {

Graph make_random_graph(std::uint32_t nodes, std::size_t edges, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<glm::uvec2> pairs;
    while (pairs.size() < edges) {
        const auto a = static_cast<std::uint32_t>(random() % nodes),
                   b = static_cast<std::uint32_t>(random() % nodes);
        if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return make_graph(nodes, pairs);
}

Graph graph_of_block() {
    const TetMesh block = test::make_block({9, 8, 7}, {0.9, 0.8, 0.7}, 0.2);
    return make_graph(block.positions.size(), tet_edges(block.tets));
}

std::uint32_t highest_degree(const Graph& graph) {
    std::uint32_t highest = 0;
    for (std::uint32_t n = 0; n + 1 < graph.starts.size(); ++n) highest = std::max(highest, graph.degree(n));
    return highest;
}

void expect_colored(const Graph& graph, const NodeColors& colors) {
    const std::size_t nodes = graph.starts.size() - 1;
    ASSERT_EQ(colors.nodes.size(), nodes);
    ASSERT_EQ(colors.starts.back(), nodes);
    EXPECT_LE(colors.count(), highest_degree(graph) + 1);
    std::vector<std::uint32_t> color(nodes, colors.count());
    for (std::uint32_t c = 0; c < colors.count(); ++c) {
        EXPECT_FALSE(colors.of(c).empty());
        EXPECT_TRUE(std::is_sorted(colors.of(c).begin(), colors.of(c).end()));
        for (const std::uint32_t n : colors.of(c)) color[n] = c;
    }
    for (std::uint32_t n = 0; n < nodes; ++n) {
        ASSERT_LT(color[n], colors.count()) << "node " << n << " has no colour";
        for (const std::uint32_t other : graph.row(n)) EXPECT_NE(color[n], color[other]);
    }
}

TEST(NodeColors, NeighboursDiffer) {
    expect_colored(graph_of_block(), color_nodes(graph_of_block()));
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Graph graph = make_random_graph(1000, 1500 * seed * seed, seed);
        expect_colored(graph, color_nodes(graph));
    }
}

// The order takes at most one colour more than the highest k for which some subgraph's nodes all have k
// neighbours in it; a tree has no such part above 1, whatever its degrees.
TEST(NodeColors, OfATreeAreTwo) {
    std::mt19937 random(5);
    std::vector<glm::uvec2> edges;
    for (std::uint32_t n = 1; n < 1000; ++n) edges.emplace_back(static_cast<std::uint32_t>(random() % n), n);
    const Graph tree = make_graph(1000, edges);
    EXPECT_EQ(color_nodes(tree).count(), 2u);
    expect_colored(tree, color_nodes(tree));
}

TEST(NodeColors, AreBalanced) {
    const NodeColors colors = color_nodes(graph_of_block());
    const double mean = static_cast<double>(colors.nodes.size()) / colors.count();
    for (std::uint32_t c = 0; c < colors.count(); ++c) {
        EXPECT_LT(static_cast<double>(colors.of(c).size()), 1.5 * mean);
        EXPECT_GT(static_cast<double>(colors.of(c).size()), 0.5 * mean);
    }
}

TEST(NodeColors, OfNothingAreNone) {
    EXPECT_EQ(color_nodes(make_graph(0, {})).count(), 0u);
    EXPECT_EQ(color_nodes(make_graph(5, {})).count(), 1u) << "nodes without neighbours share one";
}

}  // namespace
}  // namespace gelatin
