#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// Volumes over those at rest between which a first guess is taken for sound.
using thresholds::kLeastSound, thresholds::kMostSound;

/// The volumes of all tets, and which tets of springs are flat and resist that (docs/block-descent.md). Flat
/// tets are rare: their nodes are found now and then, and they are added node by node.
template <class Real>
class FlatTets {
public:
    /// @param rows whose batches are updated one by one
    FlatTets(std::shared_ptr<const Model> model, const DescentRows& rows);

    const NodeTets& node_tets() const { return node_tets_; }  ///< of all tets of the model
    std::span<const Real> ratios() const { return ratios_; }  ///< J of each tet at its last update

    /// True if a tet of the object is far from its volume at rest (kLeastSound, kMostSound).
    bool is_tangled(const ModelObject& object, const std::vector<Vec4<Real>>& positions) const;

    /// Finds the volumes of a batch's tets, and which are flat.
    /// @param rows as for the constructor
    void update(std::size_t index, const DescentRows& rows, const std::vector<Vec4<Real>>& positions);

    /// True if a tet of the batch, or of any, was flat at its last update.
    bool any(std::size_t batch) const { return any_[batch] != 0; }
    bool any() const {
        return std::any_of(any_.begin(), any_.end(), [](auto flat) { return flat != 0; });
    }

    /// Adds the resistance of the node's tets.
    void add(std::uint32_t node, const std::vector<Vec4<Real>>& positions, NodeTerms<Real>& terms) const;

private:
    void update_range(const Range& tets, std::uint8_t& any_flat, const std::vector<Vec4<Real>>& positions);

    std::shared_ptr<const Model> model_;
    NodeTets node_tets_;
    std::vector<Real> ratios_;           // by tet
    std::vector<std::uint8_t> is_near_;  // nodes of flat tets
    std::vector<std::uint8_t> any_;      // by batch
};

}  // namespace gelatin::cpu
