#include "gpu/elasticity/volume_term_buffers.h"

#include <numeric>

#include "model/elasticity/tet_strips.h"

namespace gelatin::gpu {

VolumeTermBuffers::VolumeTermBuffers(const Model& model) {
    const VolumeTerm& term = model.volume_term;
    if (term.is_empty()) return;
    std::vector<std::uint32_t> nodes(model.node_count());
    std::iota(nodes.begin(), nodes.end(), 0u);
    const NodeTets node_tets = make_node_tets(model.node_count(), model.tets);
    const StripSlices<VolumeStep> packed = pack_volume_strips({model, node_tets}, nodes);
    strips_ = {packed.steps, gl::TexelFormat::rgba32ui};
    slice_starts_ = {packed.slice_starts, gl::TexelFormat::r32ui};
    nodes_ = {term.nodes, gl::TexelFormat::rg32f};
}

gl::Defines VolumeTermBuffers::defines(const Model& model) {
    if (model.volume_term.is_empty()) return {};
    return {"VOLUME"};
}

void VolumeTermBuffers::bind(const gl::Program& program) const {
    if (strips_.is_empty()) return;
    program.bind("volume_strips", strips_);
    program.bind("volume_starts", slice_starts_);
    program.bind("node_volumes", nodes_);
}

}  // namespace gelatin::gpu
