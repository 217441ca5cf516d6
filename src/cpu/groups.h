#pragma once

#include <array>
#include <cstdint>

#include "model/spring_packing.h"

namespace gelatin::cpu {

/// Rows that SIMD takes at a time, in one piece or several.
constexpr std::uint32_t kGroup = 8;
static_assert(HalfSprings::kSlice % kGroup == 0);

/// A group's nodes, for loading: rows without one show one that exists.
inline std::array<std::uint32_t, kGroup> shown_nodes(const std::uint32_t* nodes) {
    std::array<std::uint32_t, kGroup> shown;
    for (std::uint32_t r = 0; r < kGroup; ++r) shown[r] = nodes[r] == kNoNode ? 0 : nodes[r];
    return shown;
}

}  // namespace gelatin::cpu
