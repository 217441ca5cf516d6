#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/layouts.h"
#include "model/shared_constants.h"

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
    static constexpr std::uint32_t kNoEntry = packing::kNone;

    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<std::uint32_t> entries;       ///< shape [slice_starts.back()]
};

/// @param rows nodes, each at most once, or kNoNode
NodeTetSlices pack_node_tets(std::span<const std::uint32_t> rows, const NodeTets& node_tets);

/// A tet as its corner `place` sees it: the other three counter-clockwise.
constexpr int kOppositeCorners[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// Those of each row's node in slices of 64 rows, laid out as HalfSprings' pairs are.
struct TetCorners {
    static constexpr std::uint32_t kSlice = packing::kSlice;

    std::vector<std::uint32_t> slice_starts;  ///< shape [slices + 1]
    std::vector<TetCorner> corners;           ///< shape [slice_starts.back()]

    /// Calls `work` with each tet of a row, and with tets without volume that pad it.
    template <class Work>
    void for_row(std::uint32_t row, const Work& work) const {
        const std::uint32_t start = slice_starts[row / kSlice], end = slice_starts[row / kSlice + 1];
        for (std::uint32_t e = start + row % kSlice; e < end; e += kSlice) work(corners[e]);
    }
};

/// @param rows nodes, each at most once, or kNoNode
TetCorners pack_tet_corners(std::span<const std::uint32_t> rows, const NodeTets& node_tets,
                            std::span<const glm::uvec4> tets);

}  // namespace gelatin
