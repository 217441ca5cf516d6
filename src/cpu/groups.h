#pragma once

#include <array>
#include <cstdint>

#include "model/spring_packing.h"

namespace gelatin::cpu {

/// Rows that SIMD takes at a time, in one piece or several.
constexpr std::uint32_t kGroup = 8;
static_assert(HalfSprings::kSlice % kGroup == 0);

/// Rows without a node are a colour's last ones.
inline bool is_empty_group(const std::uint32_t* nodes) {
    return nodes[0] == kNoNode;
}

/// A group's nodes, for loading: rows without one show the first, which no other thread moves meanwhile.
/// @pre the group is not empty
inline std::array<std::uint32_t, kGroup> shown_nodes(const std::uint32_t* nodes) {
    std::array<std::uint32_t, kGroup> shown;
    for (std::uint32_t r = 0; r < kGroup; ++r) shown[r] = nodes[r] == kNoNode ? nodes[0] : nodes[r];
    return shown;
}

}  // namespace gelatin::cpu
