#pragma once

#include <optional>
#include <vector>

#include "core/stage_timer.h"
#include "gl/program.h"
#include "gpu/descent/coarse_step.h"
#include "gpu/descent/collider_contacts.h"
#include "gpu/descent/rigid_move.h"
#include "gpu/descent/step_objective.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Vertex block descent: start_descent.comp and take_back_tangled.comp of shaders/sim/descent/; then three
/// moves lower a sum of elements (StepObjective) in turn: sweeps over nodes (descend.comp), RigidMove and
/// CoarseStep. CPU twin: cpu::BlockDescent.
class BlockDescent {
public:
    BlockDescent(const Model& model, const DescentSettings& settings);

    /// A step of `step` seconds from `previous`; writes `current`. Ends with the barrier that whoever gathers
    /// the nodes as textures or storage needs.
    /// @param loads of this step; null in models without
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else not looked at
    /// @param timer of the parts of the step, with the names that cpu::BlockDescent has; null: none
    void run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
             const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer = nullptr);

private:
    void bind_buffers() const;
    std::vector<const gl::Program*> gathering_programs() const;
    void start(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
               const NodeBuffers& current, double step, bool has_earlier) const;
    void take_back_tangled(const NodeBuffers& current) const;
    void begin_moves(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                     double step);
    void sweep() const;

    DescentSettings settings_;
    std::uint32_t node_count_, tet_count_, object_count_;
    gl::Program start_program_, find_tangled_program_, take_back_program_, sweep_program_;
    gl::TexelTable<std::uint32_t> node_objects_;
    gl::Buffer<std::uint32_t> is_tangled_;  // by object
    StepObjective objective_;
    ColliderContacts contacts_;
    RigidMove rigid_move_;
    std::optional<CoarseStep> coarse_;  // where there are clusters
};

}  // namespace gelatin::gpu
