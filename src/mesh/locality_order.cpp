#include <algorithm>
#include <utility>

#include "mesh/topology.h"

namespace gelatin {

namespace {

/// Breadth-first sweeps over a graph, with shared working memory.
class Sweeper {
public:
    explicit Sweeper(const Graph& graph) : graph_(graph), seen_in_(graph.starts.size() - 1, 0) {}

    bool was_seen(std::uint32_t node) const { return seen_in_[node] != 0; }

    /// Appends the component of `start` to `order`, level by level, the neighbours of each node by ascending
    /// degree, then by index (Cuthill and McKee 1969). Returns where in `order` the last level begins, and
    /// the number of levels.
    std::pair<std::size_t, std::uint32_t> sweep(std::uint32_t start, std::vector<std::uint32_t>& order) {
        ++sweep_;
        std::size_t level_begin = order.size();
        std::uint32_t levels = 1;
        append(start, order);
        for (std::size_t level_end = order.size();; level_end = order.size(), ++levels) {
            for (std::size_t k = level_begin; k < level_end; ++k) append_neighbours(order[k], order);
            if (order.size() == level_end) return {level_begin, levels};
            level_begin = level_end;
        }
    }

    /// A node from which a sweep has many, and therefore narrow, levels (George and Liu 1979, at most three
    /// sweeps).
    std::uint32_t find_far_node(std::uint32_t start) {
        std::uint32_t most_levels = 0;
        for (int tries = 0; tries < 3; ++tries) {
            component_.clear();
            const auto [last_level, levels] = sweep(start, component_);
            if (levels <= most_levels) break;
            most_levels = levels;
            start = *std::min_element(component_.begin() + static_cast<std::ptrdiff_t>(last_level),
                                      component_.end(),
                                      [&](std::uint32_t a, std::uint32_t b) { return has_fewer(a, b); });
        }
        return start;
    }

private:
    bool has_fewer(std::uint32_t a, std::uint32_t b) const {
        return std::pair(graph_.degree(a), a) < std::pair(graph_.degree(b), b);
    }

    void append(std::uint32_t node, std::vector<std::uint32_t>& order) {
        seen_in_[node] = sweep_;
        order.push_back(node);
    }

    void append_neighbours(std::uint32_t node, std::vector<std::uint32_t>& order) {
        const auto begin = static_cast<std::ptrdiff_t>(order.size());
        for (const std::uint32_t other : graph_.row(node)) {
            if (seen_in_[other] != sweep_) append(other, order);
        }
        std::sort(order.begin() + begin, order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return has_fewer(a, b); });
    }

    const Graph& graph_;
    std::vector<std::uint32_t> seen_in_;  // the last sweep that reached the node; 0 for none
    std::uint32_t sweep_ = 0;
    std::vector<std::uint32_t> component_;
};

}  // namespace

std::vector<std::uint32_t> locality_order(const Graph& graph, std::uint32_t window) {
    const auto node_count = static_cast<std::uint32_t>(graph.starts.size() - 1);
    std::vector<std::uint32_t> order;
    order.reserve(node_count);
    Sweeper sweeper(graph);
    for (std::uint32_t node = 0; node < node_count; ++node) {
        if (sweeper.was_seen(node)) continue;
        const auto begin = static_cast<std::ptrdiff_t>(order.size());
        sweeper.sweep(sweeper.find_far_node(node), order);
        std::reverse(order.begin() + begin, order.end());
    }

    // If nodes that are adjacent in memory have equally long rows, the invocations of a GPU's subgroup (or
    // the lanes of a vector) finish together.
    const std::size_t step = std::max(window, 1u);
    for (std::size_t begin = 0; begin < node_count; begin += step) {
        const std::size_t end = std::min<std::size_t>(begin + step, node_count);
        std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                         order.begin() + static_cast<std::ptrdiff_t>(end),
                         [&](std::uint32_t a, std::uint32_t b) { return graph.degree(a) > graph.degree(b); });
    }
    return order;
}

}  // namespace gelatin
