#pragma once

#include <span>
#include <vector>

#include "cpu/elasticity/tet_blocks.h"
#include "model/descent/descent_rows.h"
#include "model/model.h"

namespace gelatin::cpu {

/// VolumeBound (cpu/elasticity/tet_volume.inl) of the tets of a step's sweeps, in float with SIMD.
class VolumeBounds {
public:
    VolumeBounds() = default;
    VolumeBounds(const Model& model, const TetBlocks& blocks);

    /// Finds the offsets of a batch's tets. @param nodes of the blocks' rows, or kNoNode @param ratios J of
    /// each tet, shape [tets]
    void update(const Model& model, const TetBlocks& blocks, const DescentBatch& batch,
                std::span<const std::uint32_t> nodes, std::span<const float> ratios);

    /// Offsets of the tets in the blocks' order [J]; empty without a volume term.
    const TetOffsets& offsets() const { return in_blocks_; }

private:
    std::vector<float> volumes_;    // of tets [m^3]; then 0, for blocks without a tet
    std::vector<float> pressures_;  // of nodes [Pa]
    std::vector<float> offsets_;    // of tets [J]; then 0, as above
    TetOffsets in_blocks_;
};

}  // namespace gelatin::cpu
