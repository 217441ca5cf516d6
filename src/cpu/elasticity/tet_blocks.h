#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cpu/groups.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A NeoHookeanCorner (shaders/layouts/neo_hookean_corner.glsl) of each row of a group.
struct alignas(32) NeoHookeanBlock {  // 384 bytes
    using Column = std::array<float, kGroup>;
    std::array<std::array<std::uint32_t, kGroup>, 3> nodes;  ///< a, b and c, counter-clockwise from the node
    Column aa, ab, bb, ac, bc, cc;                           ///< [1/m]
    Column mu, lambda;                                       ///< times V [J]; 0 where a row has no more
    std::array<std::uint32_t, kGroup> tets;                  ///< in Model::tets
};

/// A tet of springs of each row of a group, for its part of the volume term.
struct alignas(32) VolumeBlock {                             // 160 bytes
    std::array<std::array<std::uint32_t, kGroup>, 3> nodes;  ///< as above
    std::array<float, kGroup> inverse_six_volumes;           ///< 1 / (6 V) [1/m^3]; 0 where a row has no more
    std::array<std::uint32_t, kGroup> tets;                  ///< as above
};

/// The tets of rows of nodes as SIMD reads them: a group's blocks one after another, and group after group.
struct TetBlocks {
    std::vector<NeoHookeanBlock> neo_hookean;
    std::vector<std::array<glm::vec3, kGroup>>
        openings;                                   ///< mu V g of each of them, read if it is collapsed [N]
    std::vector<VolumeBlock> volumes;               ///< none if the model has no volume term
    std::vector<std::uint32_t> neo_hookean_starts;  ///< of each group, and the end, shape [groups + 1]
    std::vector<std::uint32_t> volume_starts;
    bool is_damped = false;  ///< whether any of the model's nodes are

    bool is_empty() const { return neo_hookean.empty() && volumes.empty(); }
};

/// @param nodes of the rows, or kNoNode, whole groups @param node_tets those of the model's tets
TetBlocks make_tet_blocks(const Model& model, const std::vector<std::uint32_t>& nodes,
                          const NodeTets& node_tets);

}  // namespace gelatin::cpu
