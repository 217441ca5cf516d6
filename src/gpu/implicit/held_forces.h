#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/model_buffers.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// What pins and handles exert where the last part of a step has ended, for those who ask. CPU twins:
/// cpu::ImplicitStep::find_forces_on_held, cpu::SystemSolver::holding_forces.
class HeldForces {
public:
    /// @pre the model has handles @param model, state, system have to live as long
    HeldForces(const Model& model, const StepState& state, const StepSystem& system);

    /// After StepSystem::grow.
    void bind_buffers() const;
    /// Blocks until the device has ended its tries. @param loads those of the last part; null: there are none
    /// @param size of the last step; 0: none was made, and nothing is known [s]
    HoldingForces read(const ModelBuffers& buffers, const SumLoads* loads, double size) const;

private:
    const Model& model_;
    const StepState& state_;
    const StepSystem& system_;
    gl::Program program_;
    gl::Buffer<glm::vec4> forces_;
};

}  // namespace gelatin::gpu
