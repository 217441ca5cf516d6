#pragma once

#include "gl/program.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The volume term's stress around each node, for explicit solvers:
/// shaders/sim/explicit/find_volume_stresses.comp. CPU twin: cpu::find_volume_stresses.
class FindVolumeStresses {
public:
    /// @pre the model has a volume term
    explicit FindVolumeStresses(const Model& model);

    /// Binds the stresses to texture unit 11, where sim/elasticity/volume_force.glsl reads them, after the
    /// barrier that this needs.
    void run(const ModelBuffers& model, const NodeBuffers& at) const;

private:
    gl::Program program_;
    gl::Buffer<float> stresses_;  // [Pa]
    gl::BufferTexture stress_texels_;
};

}  // namespace gelatin::gpu
