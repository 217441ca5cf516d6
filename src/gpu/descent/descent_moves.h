#pragma once

#include <optional>
#include <vector>

#include "core/stage_timer.h"
#include "gl/program.h"
#include "gpu/descent/coarse_step.h"
#include "gpu/descent/collider_contacts.h"
#include "gpu/descent/rigid_move.h"
#include "gpu/descent/step_objective.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The moves of a step of block descent that lower its objective in turn, from a first guess on: sweeps over
/// nodes (descend.comp), RigidMove and CoarseStep. CPU twin: cpu::BlockDescent::make_sweeps.
class DescentMoves {
public:
    DescentMoves(const Model& model, bool has_coarse_level);

    StepObjective objective;
    ColliderContacts contacts;

    /// To be called when the objective's starts and targets, and the guess, are those of a step of `step`
    /// seconds. @param current's positions: the guess, moved by run()
    void begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
               double step);

    /// Ends with the barrier that whoever gathers the nodes as textures or storage needs. Also writes the
    /// velocities that the step ends with.
    /// @param current that of begin()
    /// @param timer of the parts of the step, with the names that cpu::BlockDescent has; null: none
    void run(int sweeps, const NodeBuffers& current, StageTimer* timer = nullptr);

private:
    std::vector<const gl::Program*> gathering_programs() const;
    void sweep() const;

    gl::Program sweep_program_;
    RigidMove rigid_move_;
    std::optional<CoarseStep> coarse_;  // where there are clusters
};

}  // namespace gelatin::gpu
