#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin {

/// After so many sweeps bodies move as rigid ones, and before them flat tets are found. With fewer motions
/// stiff bodies that slide are held back by what they lie on; with fewer updates bodies gain energy that turn
/// inside out.
constexpr int kSweepsAMotion = 2;

/// Before so many sweeps the volume term's bounds are found. With bounds before every second sweep, steps
/// come no closer to converged ones.
constexpr int kSweepsABound = 4;
static_assert(kSweepsABound % kSweepsAMotion == 0);

/// What is found out about tets before a sweep.
enum class TetUpdate {
    none,
    flat,  ///< which are flat
    all,   ///< and the bounds of the volume term
};

/// @param sweep its number in the step
constexpr TetUpdate tet_update_before(int sweep) {
    if (sweep % kSweepsABound == 0) return TetUpdate::all;
    return sweep % kSweepsAMotion == 0 ? TetUpdate::flat : TetUpdate::none;
}

/// Of so many sweeps the first is followed by a coarse correction (model/descent/coarse_basis.h), which has
/// the tets as the last update found them.
constexpr int kSweepsACorrection = 6;
static_assert(kSweepsACorrection % kSweepsAMotion == 0);

/// How many corrections a step of `sweeps` has: none after the last.
constexpr int correction_count(int sweeps) {
    return sweeps < 2 ? 0 : (sweeps - 2) / kSweepsACorrection + 1;
}

/// Bodies that descend together. Bodies do not meet within a step, so batches need not wait for each other.
struct DescentBatch {
    Range objects, nodes, tets;
    std::vector<Range> colors;  ///< rows
};

/// Nodes in the order in which block descent moves them: by batch, then colour, each colour filled up to
/// whole slices of HalfSprings::kSlice rows with rows that have no node.
struct DescentRows {
    std::vector<std::uint32_t> nodes;  ///< kNoNode where there is none, shape [rows]
    std::vector<DescentBatch> batches;
    HalfSprings springs;  ///< of each row's node
};

/// @param nodes_a_batch at most, but for bodies of more
DescentRows make_descent_rows(const Model& model,
                              std::uint32_t nodes_a_batch = std::numeric_limits<std::uint32_t>::max());

}  // namespace gelatin
