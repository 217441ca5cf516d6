#include "model/descent/node_colors.h"

#include <algorithm>
#include <numeric>

namespace gelatin {
namespace {

constexpr std::uint32_t kNoColor = 0xFFFFFFFFu;

std::uint32_t node_count(const Graph& graph) {
    return static_cast<std::uint32_t>(graph.starts.size() - 1);
}

std::uint32_t highest_degree(const Graph& graph) {
    std::uint32_t highest = 0;
    for (std::uint32_t n = 0; n < node_count(graph); ++n) highest = std::max(highest, graph.degree(n));
    return highest;
}

// The node that has the fewest neighbours among those that are left goes last, one by one: each then has few
// before it. Nodes wait in lists by that number, once for each that they have had; the last one counts.
std::vector<std::uint32_t> smallest_last(const Graph& graph) {
    std::vector<std::uint32_t> left(node_count(graph));  // neighbours that are left
    std::vector<std::vector<std::uint32_t>> waiting(highest_degree(graph) + 1);
    for (std::uint32_t n = 0; n < left.size(); ++n) {
        left[n] = graph.degree(n);
        waiting[left[n]].push_back(n);
    }
    std::vector<std::uint32_t> order;
    std::vector<bool> is_placed(left.size(), false);
    for (std::uint32_t least = 0; order.size() < left.size();) {
        if (waiting[least].empty()) {
            ++least;
            continue;
        }
        const std::uint32_t n = waiting[least].back();
        waiting[least].pop_back();
        if (is_placed[n] || left[n] != least) continue;
        is_placed[n] = true;
        order.push_back(n);
        for (const std::uint32_t other : graph.row(n)) {
            if (is_placed[other]) continue;
            waiting[--left[other]].push_back(other);
            least = std::min(least, left[other]);
        }
    }
    std::reverse(order.begin(), order.end());
    return order;
}

// Which colours the neighbours of a node have; cleared by the search for the next node.
class Neighbors {
public:
    explicit Neighbors(std::size_t color_count) : taken_(color_count, 0) {}

    void look(const Graph& graph, const std::vector<std::uint32_t>& colors, std::uint32_t node) {
        ++look_;
        for (const std::uint32_t other : graph.row(node)) {
            if (colors[other] != kNoColor) taken_[colors[other]] = look_;
        }
    }
    bool allow(std::uint32_t color) const { return taken_[color] != look_; }

private:
    std::vector<std::uint32_t> taken_;  // the search that found it
    std::uint32_t look_ = 0;
};

std::vector<std::uint32_t> color_greedily(const Graph& graph) {
    Neighbors neighbors(highest_degree(graph) + 1);
    std::vector<std::uint32_t> colors(node_count(graph), kNoColor);
    for (const std::uint32_t n : smallest_last(graph)) {
        neighbors.look(graph, colors, n);
        colors[n] = 0;
        while (!neighbors.allow(colors[n])) ++colors[n];
    }
    return colors;
}

void balance(const Graph& graph, std::vector<std::uint32_t>& colors) {
    const std::uint32_t count = colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
    std::vector<std::uint32_t> sizes(count, 0);
    for (const std::uint32_t color : colors) ++sizes[color];
    const std::uint32_t mean = count > 0 ? node_count(graph) / count : 0;
    Neighbors neighbors(count);
    for (std::uint32_t n = 0; n < colors.size(); ++n) {
        if (sizes[colors[n]] <= mean) continue;
        neighbors.look(graph, colors, n);
        std::uint32_t best = colors[n];
        for (std::uint32_t c = 0; c < count; ++c) {
            if (neighbors.allow(c) && sizes[c] + 1 < sizes[best]) best = c;
        }
        --sizes[colors[n]];
        ++sizes[best];
        colors[n] = best;
    }
}

}  // namespace

NodeColors color_nodes(const Graph& graph) {
    std::vector<std::uint32_t> colors = color_greedily(graph);
    balance(graph, colors);
    NodeColors result;
    result.nodes.resize(colors.size());
    std::iota(result.nodes.begin(), result.nodes.end(), 0u);
    std::stable_sort(result.nodes.begin(), result.nodes.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return colors[a] < colors[b]; });
    for (std::size_t k = 0; k < colors.size(); ++k) {
        if (k == 0 || colors[result.nodes[k]] != colors[result.nodes[k - 1]])
            result.starts.push_back(static_cast<std::uint32_t>(k));
    }
    result.starts.push_back(static_cast<std::uint32_t>(colors.size()));
    return result;
}

NodeColors color_nodes(const Model& model) {
    std::vector<glm::uvec2> edges = tet_edges(model.tets);
    edges.reserve(edges.size() + model.springs.size());
    for (const Spring& spring : model.springs) {
        edges.emplace_back(std::min(spring.i, spring.j), std::max(spring.i, spring.j));
    }
    std::sort(edges.begin(), edges.end(),
              [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return color_nodes(make_graph(model.node_count(), edges));
}

}  // namespace gelatin
