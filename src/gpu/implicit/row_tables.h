#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "model/model.h"

namespace gelatin::gpu {

/// Which rows, bodies and nodes of a step belong together. Sorted, so that all sums have a fixed order.
struct RowTables {
    std::vector<StepRow> rows;                    ///< by island and objects; their objects as in pairs
    std::vector<StepIsland> islands;              ///< shape [objects]; empty ones follow
    std::vector<std::uint32_t> island_of_object;  ///< packing::kNone of what is no body
    std::vector<std::uint32_t> island_bodies, island_chunks;
    std::vector<StepPair> pairs;         ///< the number of objects for what rows do not move as a rigid body
    std::vector<glm::uvec2> row_chunks;  ///< rows: first, end
    std::vector<std::uint32_t> coupling_starts, couplings;  ///< by object: 2 pair + side
    std::vector<std::uint32_t> entry_starts, row_entries;   ///< by node: 4 row + place
};

struct RowTableSizes {
    std::uint32_t objects = 0, nodes = 0;
    std::vector<std::uint32_t> chunk_starts;  ///< of the nodes of each object, and the end
};

/// @param rows of objects; packing::kNone: a plane. Nodes of weight 0 do not count.
/// @param islands_of_bodies of each body the least one of its island; packing::kNone: it sleeps, all of its
/// nodes are held, and nothing moves it. Of a row one side at least has an island.
RowTables make_row_tables(const RowTableSizes& sizes, std::span<const StepRow> rows,
                          std::span<const std::uint32_t> islands_of_bodies);

}  // namespace gelatin::gpu
