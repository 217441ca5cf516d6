#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "model/layouts.h"

namespace gelatin {

struct Model;

/// The pairs of nodes that springs and tets join, by which the stiffness of a step is summed: without
/// elements that resist translation, matrices between two nodes are all of it. Lists are in slices of 64
/// rows, laid out as HalfSprings' pairs are, and padded with packing::kNone.
struct ElementEdges {
    std::vector<ElementEdge> edges;  ///< ascending by their nodes; two springs of one pair are two edges
    /// One row an edge: the tets that share it, 16 t + 4 c + e with the corners c where its lower node is,
    /// and e where its upper one is. Of an edge that several springs have, with the first alone.
    std::vector<std::uint32_t> tet_starts, tets;  ///< slices, and the end; entries
    /// One row a node: 2 edge, + 1 from its upper node; and the other node.
    std::vector<std::uint32_t> half_starts;
    std::vector<glm::uvec2> halves;
};

ElementEdges make_element_edges(const Model& model);

}  // namespace gelatin
