#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"

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

/// A half spring of each row of a group.
struct alignas(32) SpringBlock {              // 96 bytes
    std::array<std::uint32_t, kGroup> nodes;  ///< the other ends
    std::array<float, kGroup> rest_lengths;   ///< [m]
    std::array<float, kGroup> stiffnesses;    ///< [N/m]; 0 where a row has no more
};

/// The springs of DescentRows as SIMD reads them: a group's blocks one after another, and group after group.
struct SpringBlocks {
    std::vector<SpringBlock> blocks;
    std::vector<std::uint32_t> starts;  ///< of each group in blocks, and the end, shape [groups + 1]
};

SpringBlocks make_spring_blocks(const DescentRows& rows);

/// Springs with their dampers as springs without: what cpu::add_spring makes of them, which is the same for a
/// whole step. So sweeps do not read where nodes started.
/// @param nodes of the rows @param starts xyz when the step began [m], damping time [s], shape [nodes]
/// @param inverse_step [1/s] @param damped as `springs`; its stiffnesses and rest lengths are written
void damp_springs(const SpringBlocks& springs, std::span<const std::uint32_t> nodes, const glm::vec4* starts,
                  float inverse_step, SpringBlocks& damped);

}  // namespace gelatin::cpu
