#include "gpu/volume_term_buffers.h"

namespace gelatin::gpu {

VolumeTermBuffers::VolumeTermBuffers(const Model& model) {
    const VolumeTerm& term = model.volume_term;
    if (term.is_empty()) return;
    corners_ = gl::Buffer<TetCorner>(std::span(term.corners.corners));
    slice_starts_ = gl::Buffer<std::uint32_t>(std::span(term.corners.slice_starts));
    nodes_ = gl::Buffer<glm::vec2>(std::span(term.nodes));
    corner_texels_ = {corners_, gl::TexelFormat::rgba32ui};
    slice_start_texels_ = {slice_starts_, gl::TexelFormat::r32ui};
    node_texels_ = {nodes_, gl::TexelFormat::rg32f};
}

gl::Defines VolumeTermBuffers::defines(const Model& model) {
    if (model.volume_term.is_empty()) return {};
    return {"VOLUME"};
}

void VolumeTermBuffers::bind() const {
    if (nodes_.empty()) return;
    corner_texels_.bind(8);
    slice_start_texels_.bind(9);
    node_texels_.bind(10);
}

}  // namespace gelatin::gpu
