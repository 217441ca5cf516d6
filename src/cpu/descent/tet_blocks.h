#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "cpu/descent/spring_blocks.h"
#include "model/model.h"

namespace gelatin::cpu {

/// A neo-Hookean tet of each row of a group, as the row's node sees it.
///
/// Energies do not depend on how the rest shape is rotated. So it is rotated such that the shape gradients of
/// the other corners a, b and c are the columns of a triangular matrix: (aa, 0, 0), (ab, bb, 0), (ac, bc,
/// cc). Then F has the columns aa d_a + ab d_b + ac d_c, bb d_b + bc d_c and cc d_c, with d_a the vector from
/// the node to a, and 6 V aa bb cc = 1.
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
    std::array<float, kGroup> over_six_volumes;              ///< 1 / (6 V) [1/m^3]; 0 where a row has no more
    std::array<std::uint32_t, kGroup> tets;                  ///< as above
};

/// The tets of DescentRows as SIMD reads them: a group's blocks one after another, and group after group.
struct TetBlocks {
    std::vector<NeoHookeanBlock> neo_hookean;
    std::vector<std::array<glm::vec3, kGroup>>
        openings;                                   ///< mu V g of each of them, read if it is collapsed [N]
    std::vector<VolumeBlock> volumes;               ///< none if the model has no volume term
    std::vector<std::uint32_t> neo_hookean_starts;  ///< of each group, and the end, shape [groups + 1]
    std::vector<std::uint32_t> volume_starts;

    bool is_empty() const { return neo_hookean.empty() && volumes.empty(); }
};

/// @param nodes of the rows, or kNoNode @param node_tets those of the model's tets
TetBlocks make_tet_blocks(const Model& model, const std::vector<std::uint32_t>& nodes,
                          const NodeTets& node_tets);

}  // namespace gelatin::cpu
