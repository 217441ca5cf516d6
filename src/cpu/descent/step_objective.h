#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/descend_groups.h"
#include "cpu/descent/spring_blocks.h"
#include "cpu/descent/tet_resistance.h"
#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What a step of vertex block descent minimises (cpu/descent/block_descent.h), inertia, springs and tets, as
/// each node sees it. Colliders are left out.
template <class Real>
class StepObjective {
public:
    /// @param nodes_a_batch as make_descent_rows has it
    StepObjective(std::shared_ptr<const Model> model, std::uint32_t nodes_a_batch);

    std::vector<Vec4<Real>> starts;   ///< xyz when the step began [m], damping time [s], shape [nodes]
    std::vector<Vec4<Real>> targets;  ///< y [m], m / h^2 [N/m], 0 where a node is held, shape [nodes]

    /// To be called when both are those of a step of `step` seconds.
    void begin(Real step);

    /// True if a tet of the object is far from its volume at rest.
    bool is_tangled(const ModelObject& object, const std::vector<Vec4<Real>>& positions) const {
        return tets_.is_tangled(object, positions);
    }
    /// Updates the state of the tets of a batch of rows() (cpu/descent/tet_resistance.h).
    void update(std::size_t batch, const std::vector<Vec4<Real>>& positions) {
        tets_.update(batch, rows_, positions);
    }

    /// Rows of nodes by batch and colour; their springs are in groups().
    const DescentRows& rows() const { return rows_; }
    /// Inertia, springs and tets but for flat ones for SIMD, in float: a template, for there is none in
    /// double.
    /// @param colliders what a sweep will look out for
    template <class Groups = DescentGroups>
    Groups groups(std::span<const ColliderBound> colliders = {}) const {
        return {has_damping_ ? damped_springs_ : springs_,
                {tets_.blocks(), tets_.offsets(), starts, inverse_step_},
                rows_.nodes,
                targets,
                colliders};
    }
    /// What flat tets add to that.
    bool any_flat_tets(std::size_t batch) const { return tets_.any_flat(batch); }
    void add_flat_tets(std::uint32_t node, const std::vector<Vec4<Real>>& positions,
                       NodeTerms<Real>& terms) const {
        tets_.add_flat_tets(node, positions, terms);
    }
    /// All terms of the node of a row, in double.
    NodeTerms<Real> terms_of(std::uint32_t row, const std::vector<Vec4<Real>>& positions) const;

    /// Minus the slope by each node that is not held [N].
    void find_forces(const std::vector<Vec4<Real>>& positions, std::vector<Vec3<Real>>& forces) const;

private:
    template <class Groups>  // as above
    void find_group_forces(const Groups& groups, std::size_t group, bool any_flat_tets,
                           const std::vector<Vec4<Real>>& positions, std::vector<Vec3<Real>>& forces) const;

    std::shared_ptr<const Model> model_;
    bool has_damping_;
    DescentRows rows_;
    TetResistance<Real> tets_;
    Real inverse_step_ = Real(0);            // [1/s]
    SpringBlocks springs_, damped_springs_;  // in float; damped ones where the model has dampers
};

}  // namespace gelatin::cpu
