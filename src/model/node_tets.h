#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/layouts.h"

namespace gelatin {

/// Tets by node: those of node n are entries[starts[n]] .. entries[starts[n + 1]], in the tets' order; an
/// entry is 4 * tet, plus the node's place among the tet's corners.
struct NodeTets {
    std::vector<std::uint32_t> starts;   ///< shape [nodes + 1]
    std::vector<std::uint32_t> entries;  ///< shape [4 * tets]
};

NodeTets make_node_tets(std::uint32_t node_count, std::span<const glm::uvec4> tets);

/// The entries of each row's node in slices of 64 rows, laid out as HalfSprings' pairs are, padded with
/// kNoEntry.
struct NodeTetSlices {
    static constexpr std::uint32_t kNoEntry = 0xFFFFFFFFu;

    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<std::uint32_t> entries;       ///< shape [slice_starts.back()]
};

/// @param rows nodes, each at most once, or kNoNode
NodeTetSlices pack_node_tets(std::span<const std::uint32_t> rows, const NodeTets& node_tets);

/// A tet as its corner `place` sees it: the other three counter-clockwise.
constexpr int kOppositeCorners[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// Those of each row's node in slices of 64 rows, laid out as HalfSprings' pairs are.
struct TetCorners {
    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<TetCorner> corners;           ///< shape [slice_starts.back()]
};

/// @param rows nodes, each at most once, or kNoNode
TetCorners pack_tet_corners(std::span<const std::uint32_t> rows, const NodeTets& node_tets,
                            std::span<const glm::uvec4> tets);

}  // namespace gelatin
