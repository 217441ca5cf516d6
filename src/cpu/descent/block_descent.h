#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/stage_timer.h"
#include "cpu/descent/coarse_step.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/descent/node_sweep.h"
#include "cpu/descent/rigid_move.h"
#include "cpu/descent/secant_step.h"
#include "cpu/descent/step_objective.h"
#include "cpu/drive/pulls.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Vertex block descent (Chen et al. 2024): a step of implicit Euler as the minimum of
///   G(x) = sum_i m_i / (2 h^2) |x_i - y_i|^2 + E(x),   y = x_t + h v_t + h^2 (g + f / m),
/// with f the force of loads. G is a sum of elements (StepObjective), and three moves lower it in turn:
/// - NodeSweep: each node by one Newton step on its own three coordinates, all nodes of one colour at once;
/// - RigidMove, after every second sweep and after the last: bodies that nothing holds, as rigid ones. That
///   keeps their momentum, which sweeps alone lose;
/// - CoarseStep, after the first of every six sweeps: clusters of nodes, for long stiff bodies that would
///   need thousands of sweeps (docs/block-descent.md).
/// Stable for any step and start. The same bits for any number of threads. What runs with OpenGL where bodies
/// do not meet; on the processor it is the oracle of that.
template <class Real>
class BlockDescent {
public:
    /// Bodies of so many nodes in all make their sweeps one batch after the other, or beside each other on
    /// several threads: less than a processor's caches hold. Smaller ones would leave lanes of SIMD empty.
    static constexpr std::uint32_t kNodesABatch = 4096;

    BlockDescent(std::shared_ptr<const Model> model, const DescentSettings& settings,
                 std::uint32_t nodes_a_batch = kNodesABatch);

    /// To be called when nodes were set from outside.
    void restart() { contacts_.restart(); }

    /// A step of `step` seconds from `previous`; writes `current`.
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else not looked at
    /// @param load_forces [N], shape [nodes], or empty @param pulls null: no hand holds anything
    /// @param timer of the parts of the step; null: none
    void run(Real step, bool has_earlier, const Nodes<Real>& previous, Nodes<Real>& current,
             std::span<const Vec4<Real>> load_forces = {}, const Pulls<Real>* pulls = nullptr,
             StageTimer* timer = nullptr);

private:
    using Positions = std::vector<Vec4<Real>>;

    void start(Real step, bool has_earlier, const Nodes<Real>& previous,
               std::span<const Vec4<Real>> load_forces, const Pulls<Real>* pulls, Nodes<Real>& current);
    void take_back_tangled(Positions& positions);
    void make_sweeps(int first, int end, Positions& positions, StageTimer* timer);
    int end_of_run(int first) const;
    template <class Visit>
    void for_batches(const Visit& visit) const;
    bool moves_bodies(int sweep) const { return is_last(sweep) || (sweep + 1) % kSweepsAMotion == 0; }
    bool is_last(int sweep) const { return sweep + 1 == settings_.iterations; }
    void finish(Real step, const Nodes<Real>& previous, Nodes<Real>& current) const;

    std::shared_ptr<const Model> model_;
    DescentSettings settings_;
    StepObjective<Real> objective_;
    ColliderContacts<Real> contacts_;
    NodeSweep<Real> sweep_;
    RigidMove<Real> rigid_move_;
    SecantStep<Real> secant_;
    std::optional<CoarseStep<Real>> coarse_;  // where there are clusters
};

}  // namespace gelatin::cpu
