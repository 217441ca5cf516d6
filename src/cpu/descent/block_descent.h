#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "cpu/descent/coarse_step.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/descend_groups.h"
#include "cpu/descent/rigid_motion.h"
#include "cpu/descent/step_objective.h"
#include "cpu/drive/pulls.h"
#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Vertex block descent (Chen et al. 2024): a step of implicit Euler as the minimum of
///   G(x) = sum_i m_i / (2 h^2) |x_i - y_i|^2 + E(x),   y = x_t + h v_t + h^2 (g + f / m),
/// with f the force of loads, found node by node, each by one Newton step on its own three coordinates, all
/// nodes of one colour at once.
/// Between sweeps, clusters of nodes move towards that minimum (cpu/descent/coarse_correction.h), which long
/// stiff bodies would need thousands of sweeps for. Between sweeps and after the last one, bodies that
/// nothing holds move as rigid ones to where G is least: that keeps their momentum, which sweeps alone lose
/// (docs/block-descent.md). Stable for any step and start. The same bits for any number of threads.
template <class Real>
class BlockDescent {
public:
    /// Bodies of so many nodes in all make their sweeps one batch after the other, or beside each other: what
    /// a processor's caches hold.
    static constexpr std::uint32_t kNodesABatch = 16384;

    BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                 std::uint32_t nodes_a_batch = kNodesABatch);

    /// A step of `step` seconds from `previous`; writes `current`.
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else not looked at
    /// @param load_forces [N], shape [nodes], or empty @param pulls null: no hand holds anything
    /// @param timer of the parts of the step; null: none
    void run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
             std::span<const Vec4<Real>> load_forces = {}, const Pulls<Real>* pulls = nullptr,
             StageTimer* timer = nullptr);

private:
    void start(Real step, bool has_earlier, const Nodes<Real>& previous,
               std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls, Nodes<Real>& current);
    void take_back_tangled(std::vector<Vec4<Real>>& positions) const;
    int end_of_run(int first) const;
    void make_sweeps(int first, int end, std::vector<Vec4<Real>>& positions, StageTimer* timer);
    void make_sweep(int index, std::size_t batch, std::vector<Vec4<Real>>& positions);
    bool updates_tets(int index) const { return index % kSweepsAMotion == 0; }
    bool moves_bodies(int index) const {
        return index + 1 == settings_.iterations || (index + 1) % kSweepsAMotion == 0;
    }
    void sweep(std::size_t batch, std::vector<Vec4<Real>>& positions);
    void move_node(std::uint32_t node, const NodeTerms<Real>& terms, std::vector<Vec4<Real>>& positions);
    template <class Groups>  // DescentGroups: a template, for there is none but in float
    void move_group(const Groups& groups, std::size_t group, bool any_flat_tets, bool any_contact,
                    std::vector<Vec4<Real>>& positions);
    Vec3<Real> outside_colliders(std::uint32_t node, const SymmetricMatrix<Real>& hessian,
                                 Vec3<Real> position);
    void move_bodies(const Range& objects, bool is_last, std::vector<Vec4<Real>>& positions) const;
    void add_contact(std::uint32_t node, const glm::dvec3& origin, const std::vector<Vec4<Real>>& positions,
                     RigidStep& body) const;
    void finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const;

    std::shared_ptr<const Model> model_;
    DescentSettings settings_;
    StepObjective<Real> objective_;
    std::optional<CoarseStep<Real>> coarse_;  // where there are clusters
    ColliderContacts<Real> contacts_;
    std::vector<ColliderBound> collider_bounds_;  // in float
};

}  // namespace gelatin::cpu
