#include "gpu/elasticity/neo_hookean_buffers.h"

#include <numeric>

#include "model/elasticity/node_tets.h"

namespace gelatin::gpu {
namespace {

std::vector<std::uint32_t> all_nodes(const Model& model) {
    std::vector<std::uint32_t> rows(model.node_count());
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
}

}  // namespace

NeoHookeanBuffers::Corners::Corners(const Model& model, std::span<const std::uint32_t> rows) {
    if (model.neo_hookean_tets.empty()) return;
    const NodeTetSlices slices = pack_node_tets(rows, model.neo_hookean_corners);
    entries_ = {slices.entries, gl::TexelFormat::r32ui};
    slice_starts_ = {slices.slice_starts, gl::TexelFormat::r32ui};
}

void NeoHookeanBuffers::Corners::bind(const gl::Program& program) const {
    if (entries_.is_empty()) return;
    program.bind("neo_hookean_corners", entries_);
    program.bind("neo_hookean_starts", slice_starts_);
}

NeoHookeanBuffers::NeoHookeanBuffers(const Model& model) : corners_(model, all_nodes(model)) {
    if (!model.neo_hookean_tets.empty()) tets_ = {model.neo_hookean_tets, gl::TexelFormat::rgba32ui};
}

gl::Defines NeoHookeanBuffers::defines(const Model& model) {
    if (model.neo_hookean_tets.empty()) return {};
    if (!model.has_damping()) return {"NEO_HOOKEAN"};
    return {"NEO_HOOKEAN", "DAMPED"};
}

void NeoHookeanBuffers::bind_tets(const gl::Program& program) const {
    if (!tets_.is_empty()) program.bind("neo_hookean_tets", tets_);
}

void NeoHookeanBuffers::bind(const gl::Program& program) const {
    bind_tets(program);
    corners_.bind(program);
}

}  // namespace gelatin::gpu
