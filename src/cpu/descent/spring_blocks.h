#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/groups.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"

namespace gelatin::cpu {

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
