#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology.h"
#include "model/model.h"

namespace gelatin {

/// Nodes in classes, their colours, of which no two are neighbours: those of one colour may move at once.
struct NodeColors {
    std::vector<std::uint32_t> nodes;   ///< by colour, ascending in each, shape [nodes]
    std::vector<std::uint32_t> starts;  ///< of colour c in nodes, and the end, shape [colours + 1]

    std::uint32_t count() const { return static_cast<std::uint32_t>(starts.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t color) const {
        return {nodes.data() + starts[color], nodes.data() + starts[color + 1]};
    }
};

/// Greedy colours, smallest last (Matula, Beck: *Smallest-Last Ordering and Clustering and Graph Coloring
/// Algorithms*, Journal of the ACM 30(3), 1983), then balanced: nodes of colours that are larger than the
/// mean move into the smallest that their neighbours allow. At most as many as the densest part of the graph
/// asks for: one more than the largest k for which some subgraph's nodes all have k neighbours in it. The
/// same for the same graph.
NodeColors color_nodes(const Graph& graph);

/// Neighbours are the ends of a spring, and the corners of a tet.
NodeColors color_nodes(const Model& model);

}  // namespace gelatin
