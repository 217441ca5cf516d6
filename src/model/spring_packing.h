#pragma once

#include <cstdint>
#include <span>

#include "model/model.h"

namespace gelatin {

/// The springs as each node sees them, in slices of 64 nodes; a node's springs keep their order.
HalfSprings pack_half_springs(std::uint32_t node_count, std::span<const Spring> springs);

/// The springs' ends by node, in the springs' order.
SpringIncidence make_incidence(std::uint32_t node_count, std::span<const Spring> springs);
SpringIncidence make_incidence(std::uint32_t node_count, std::span<const glm::uvec2> spring_nodes);

}  // namespace gelatin
