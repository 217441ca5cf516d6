#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// Of each node, up to so many nodes before it that a tet or a face joins it with; the rest are kNoNode.
/// Nearby nodes move nearly as one, so that a node is predicted from them.
constexpr std::size_t kMostNeighbours = 4;
using EarlierNeighbours = std::vector<std::array<std::uint32_t, kMostNeighbours>>;

EarlierNeighbours earlier_neighbours(const Model& model);

}  // namespace gelatin
