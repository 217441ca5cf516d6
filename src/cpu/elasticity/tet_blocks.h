#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "cpu/groups.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A NeoHookeanStep (shaders/layouts/tet_strip.glsl) of each row of a group.
struct alignas(32) NeoHookeanBlock {  // 288 bytes
    using Column = std::array<float, kGroup>;
    std::array<std::uint32_t, kGroup> nodes;  ///< the row's own behind the strip's end
    Column aa, ab, bb, ac, bc, cc;            ///< [1/m]
    Column mu;      ///< times V [J]; the sign bit is set where the oldest vertex stays
    Column lambda;  ///< times V [J]
};

/// A VolumeStep of each.
struct alignas(32) VolumeBlock {              // 64 bytes
    std::array<std::uint32_t, kGroup> nodes;  ///< as above
    /// V k by 6 V J in place of J [J/m^6]; the sign bit is set where the oldest vertex stays
    std::array<float, kGroup> modulus;
};

/// A value of each row of a block.
struct alignas(32) BlockColumn {
    std::array<float, kGroup> values;
};

/// The tets of rows of nodes as SIMD reads them: a group's blocks one after another, and group after group.
struct TetBlocks {
    /// Of a group's blocks, the first ones complete no tet.
    static constexpr std::uint32_t kEmptyBlocks = 2;

    std::vector<NeoHookeanBlock> neo_hookean;
    std::vector<std::array<glm::vec3, kGroup>> openings;  ///< mu V g, read where a tet is collapsed [N]
    std::vector<VolumeBlock> volumes;                     ///< none without a volume term
    /// Of their steps, 1 / (6 V) [1/m^3]; negative where vertices come clockwise.
    std::vector<BlockColumn> inverse_six_volumes;
    std::vector<std::uint32_t> neo_hookean_starts;  ///< of each group, and the end, shape [groups + 1]
    std::vector<std::uint32_t> volume_starts;
    bool is_damped = false;  ///< whether any of the model's nodes are

    bool is_empty() const { return neo_hookean.empty() && volumes.empty(); }
};

/// @param nodes of the rows, or kNoNode, whole groups @param node_tets those of the model's tets
TetBlocks make_tet_blocks(const Model& model, std::span<const std::uint32_t> nodes,
                          const NodeTets& node_tets);

}  // namespace gelatin::cpu
