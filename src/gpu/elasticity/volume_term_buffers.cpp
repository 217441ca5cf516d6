#include "gpu/elasticity/volume_term_buffers.h"

namespace gelatin::gpu {

VolumeTermBuffers::VolumeTermBuffers(const Model& model) {
    const VolumeTerm& term = model.volume_term;
    if (term.is_empty()) return;
    corners_ = {term.corners.corners, gl::TexelFormat::rgba32ui};
    slice_starts_ = {term.corners.slice_starts, gl::TexelFormat::r32ui};
    nodes_ = {term.nodes, gl::TexelFormat::rg32f};
}

gl::Defines VolumeTermBuffers::defines(const Model& model) {
    if (model.volume_term.is_empty()) return {};
    return {"VOLUME"};
}

void VolumeTermBuffers::bind(const gl::Program& program) const {
    if (corners_.is_empty()) return;
    program.bind("volume_corners", corners_);
    program.bind("volume_starts", slice_starts_);
    program.bind("node_volumes", nodes_);
}

}  // namespace gelatin::gpu
