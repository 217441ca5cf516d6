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

void VolumeTermBuffers::bind() const {
    corners_.bind(8);
    slice_starts_.bind(9);
    nodes_.bind(10);
}

}  // namespace gelatin::gpu
