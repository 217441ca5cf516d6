#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "cpu/descent/flat_tets.h"
#include "cpu/descent/lane_elements.h"
#include "cpu/descent/plain_elements.h"
#include "cpu/descent/step_state.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What a step of vertex block descent minimises (cpu/descent/block_descent.h): the sum of inertia, springs
/// and tets, as each node sees it. Moves (NodeSweep, RigidMove, CoarseStep) lower it. Colliders are
/// no part of it, but limits of moves.
template <class Real>
class StepObjective {
public:
    /// The float path has SIMD; in double it is the plain one.
    using Elements = std::conditional_t<std::is_same_v<Real, float>, LaneElements, PlainElements>;
    using Terms = typename Elements::Terms;  ///< NodeTerms of a group of rows

    /// @param nodes_a_batch as make_descent_rows has it
    StepObjective(std::shared_ptr<const Model> model, std::uint32_t nodes_a_batch);

    /// The step; begin() is to be called when its starts and targets are known.
    StepState<Real> step;
    void begin(Real seconds);  ///< h

    /// Rows of nodes by batch and colour.
    const DescentRows& rows() const { return rows_; }
    std::size_t group_count() const { return rows_.nodes.size() / kGroup; }

    /// True if a tet of the object is far from its volume at rest.
    bool is_tangled(const ModelObject& object, const std::vector<Vec4<Real>>& positions) const {
        return flat_tets_.is_tangled(object, positions);
    }
    /// Looks at the tets of a batch of rows().
    void update(std::size_t batch, TetUpdate update, const std::vector<Vec4<Real>>& positions);

    bool any_flat_tets(std::size_t batch) const { return flat_tets_.any(batch); }  ///< at the last update
    bool any_flat_tets() const { return flat_tets_.any(); }                        ///< of any batch

    /// Newton's step of each node of a group that is not held.
    /// @param any_flat whether flat tets are to be looked for
    /// @param terms input: none; output: those of each node, where it was
    /// @return a bit for each row: whether its node may have come into a collider
    std::uint32_t descend(std::size_t group, bool any_flat, std::vector<Vec4<Real>>& positions,
                          Terms& terms) const;

    /// Minus the slope by each node that is not held [N].
    void find_forces(const std::vector<Vec4<Real>>& positions, std::vector<Vec3<Real>>& forces) const;

private:
    void add_flat_tets(std::size_t group, const std::vector<Vec4<Real>>& positions, Terms& terms) const;

    DescentRows rows_;
    FlatTets<Real> flat_tets_;
    Elements elements_;
};

}  // namespace gelatin::cpu
