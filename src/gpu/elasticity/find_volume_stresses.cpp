#include "gpu/elasticity/find_volume_stresses.h"

namespace gelatin::gpu {

FindVolumeStresses::FindVolumeStresses(const Model& model)
    : program_(gl::Program::compute("sim/elasticity/find_volume_stresses.comp")),
      stresses_(model.positions.size()),
      stress_texels_(stresses_, gl::TexelFormat::r32f) {}

void FindVolumeStresses::run(const ModelBuffers& model, const NodeBuffers& at) const {
    program_.bind("positions", at.position_texels);
    model.volume_term.bind(program_);
    program_.bind("Stresses", stresses_);
    program_.set("node_count", model.node_count);
    program_.dispatch(model.node_count);
    gl::barrier(gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
