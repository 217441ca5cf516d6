#pragma once

#include <cstdint>
#include <span>

#include "model/model.h"

namespace gelatin {

/// A row without a node.
constexpr std::uint32_t kNoNode = packing::kNone;

/// The springs as each node sees them, in slices of 64 rows; a node's springs keep their order.
/// @param rows nodes, each at most once, or kNoNode
HalfSprings pack_half_springs(std::span<const std::uint32_t> rows, std::span<const Spring> springs);

/// The same with a row for each node, in their order.
HalfSprings pack_half_springs(std::uint32_t node_count, std::span<const Spring> springs);

/// The springs' ends by node, in the springs' order.
SpringIncidence make_incidence(std::uint32_t node_count, std::span<const Spring> springs);
SpringIncidence make_incidence(std::uint32_t node_count, std::span<const glm::uvec2> spring_nodes);

}  // namespace gelatin
