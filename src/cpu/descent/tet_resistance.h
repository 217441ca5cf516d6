#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "cpu/descent/volume_bounds.h"
#include "cpu/elasticity/elements.h"
#include "cpu/elasticity/tet_blocks.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// Volumes over those at rest between which a first guess is taken for sound.
using thresholds::kLeastSound, thresholds::kMostSound;

/// Where a step of vertex block descent began.
template <class Real>
struct StepStart {
    const Vec4<Real>* nodes;  ///< xyz [m], damping time [s], shape [nodes]
    Real inverse_step;        ///< [1/s]
};

/// The contributions of tets to vertex block descent:
/// - neo-Hookean tets, the only elements of their bodies (docs/finite-elements.md);
/// - the tets of springs, which resist being flat (docs/block-descent.md);
/// - the volume around each node, if the material's Poisson's ratio is another than its elements have
///   (docs/springs.md).
template <class Real>
class TetResistance {
public:
    /// @param rows whose batches are updated one by one
    TetResistance(std::shared_ptr<const Model> model, const DescentRows& rows);

    const TetBlocks& blocks() const { return blocks_; }                     ///< for SIMD, in float
    const TetOffsets& offsets() const { return volume_bounds_.offsets(); }  ///< as above

    /// True if a tet of the object is far from its volume at rest (kLeastSound, kMostSound).
    bool is_tangled(const ModelObject& object, const std::vector<Vec4<Real>>& positions) const;

    /// Finds which tets of a batch are flat and how far the volumes are from those at rest.
    /// @param rows as for the constructor
    void update(std::size_t index, const DescentRows& rows, const std::vector<Vec4<Real>>& positions);

    /// True if a tet of the batch, or of any, was flat at its last update.
    bool any_flat(std::size_t batch) const { return any_flat_[batch] != 0; }
    bool any_flat() const {
        return std::any_of(any_flat_.begin(), any_flat_.end(), [](auto flat) { return flat != 0; });
    }
    /// Adds the resistance of the node's tets to being flat.
    void add_flat_tets(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                       NodeTerms<Real>& terms) const;

    /// Adds the contributions of all of the node's tets.
    void add(std::uint32_t node, const std::vector<Vec4<Real>>& positions, const StepStart<Real>& start,
             NodeTerms<Real>& terms) const;

private:
    void update_range(const Range& tets, std::uint8_t& any_flat, const std::vector<Vec4<Real>>& positions);
    void update_bounds(const DescentBatch& batch);
    void add_neo_hookean_tets(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                              const StepStart<Real>& start, NodeTerms<Real>& terms) const;
    VolumeBound<Real> volume_bound(std::uint32_t tet) const;
    template <class Work>
    void for_each_tet(std::uint32_t node, const std::vector<Vec4<Real>>& positions, const Work& work) const;
    Real inverse_six_volumes(std::uint32_t tet) const;  // [1/m^3]
    Real ratio_of(std::uint32_t tet, const std::vector<Vec4<Real>>& positions) const;

    std::shared_ptr<const Model> model_;
    NodeTets node_tets_;
    std::vector<std::uint32_t> object_of_;    // by node
    std::vector<Real> ratios_;                // J, by tet
    std::vector<std::uint8_t> is_near_flat_;  // nodes of tets that resist
    std::vector<std::uint8_t> any_flat_;      // by batch
    // In double, empty without a volume term:
    std::vector<Real> node_pressures_;       // [Pa]
    std::vector<VolumeBound<Real>> bounds_;  // by tet
    // In float:
    TetBlocks blocks_;
    VolumeBounds volume_bounds_;
};

}  // namespace gelatin::cpu
