#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin {

/// After so many sweeps bodies move as rigid ones, and before them tets are looked at.
constexpr int kSweepsAMotion = 2;

/// Of so many sweeps the first is followed by a coarse correction (model/coarse_basis.h), which has the tets
/// as they were looked at before it.
constexpr int kSweepsACorrection = 6;
static_assert(kSweepsACorrection % kSweepsAMotion == 0);

/// How many sweeps lie between the last correction and sweep `sweep` of a step, from 0.
constexpr int sweeps_since_correction(int sweep) {
    return sweep == 0 ? 0 : (sweep - 1) % kSweepsACorrection;
}

/// Nodes in the order in which block descent moves them: by colour, each filled up to whole slices of
/// HalfSprings::kSlice rows with rows that have no node.
struct DescentRows {
    std::vector<std::uint32_t> nodes;  ///< kNoNode where there is none, shape [rows]
    std::vector<Range> colors;         ///< rows
    HalfSprings springs;               ///< of each row's node
};

DescentRows make_descent_rows(const Model& model);

/// The object of each node, shape [nodes].
std::vector<std::uint32_t> objects_of_nodes(const Model& model);

}  // namespace gelatin
