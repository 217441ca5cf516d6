#pragma once

#include "gl/program.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The volume term's stress around each node, for explicit solvers:
/// shaders/sim/elasticity/find_volume_stresses.comp. CPU twin: cpu::find_volume_stresses.
class FindVolumeStresses {
public:
    /// @pre the model has a volume term
    explicit FindVolumeStresses(const Model& model);

    /// Ends with the barrier that the next pass needs.
    void run(const ModelBuffers& model, const NodeBuffers& at) const;

    /// For programs that include sim/elasticity/volume_force.glsl.
    void bind(const gl::Program& program) const { program.bind("volume_stresses", stress_texels_); }

private:
    gl::Program program_;
    gl::Buffer<float> stresses_;  // [Pa]
    gl::BufferTexture stress_texels_;
};

}  // namespace gelatin::gpu
