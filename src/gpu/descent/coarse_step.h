#pragma once

#include "gl/program.h"
#include "gpu/descent/coarse_correction.h"
#include "gpu/descent/collider_contacts.h"
#include "gpu/descent/rigid_move.h"
#include "gpu/descent/step_objective.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/descent/coarse_basis.h"
#include "model/model.h"

namespace gelatin::gpu {

/// A move of block descent: all nodes at once along the motions of clusters, as far as the objective falls.
/// Forces come from descend.comp with FORCES. CPU twin: cpu::CoarseStep.
class CoarseStep {
public:
    /// @pre basis, of the model, has clusters
    CoarseStep(const Model& model, const CoarseBasis& basis, const StepObjective& objective,
               const ColliderContacts& contacts);

    /// Gathers from the objective, and is called at its updates.
    const gl::Program& force_program() const { return force_program_; }

    /// To be called when a step of `step` seconds begins.
    void begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
               double step);

    /// @param nodes of begin() @param bodies whose chunks of nodes it sums over
    void run(const NodeBuffers& nodes, const RigidMove& bodies);

private:
    void find_forces() const;

    gl::Program force_program_;
    std::uint32_t row_count_;
    CoarseCorrection correction_;
};

}  // namespace gelatin::gpu
