#include "gpu/neo_hookean_buffers.h"

#include <numeric>

#include "model/node_tets.h"

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
    entries_ = gl::Buffer<std::uint32_t>(std::span(slices.entries));
    slice_starts_ = gl::Buffer<std::uint32_t>(std::span(slices.slice_starts));
    entry_texels_ = {entries_, gl::TexelFormat::r32ui};
    slice_start_texels_ = {slice_starts_, gl::TexelFormat::r32ui};
}

void NeoHookeanBuffers::Corners::bind() const {
    if (entries_.empty()) return;
    entry_texels_.bind(14);
    slice_start_texels_.bind(15);
}

NeoHookeanBuffers::NeoHookeanBuffers(const Model& model)
    : tets_(std::span(model.neo_hookean_tets)),
      tet_texels_(tets_, gl::TexelFormat::rgba32ui),
      corners_(model, all_nodes(model)) {}

gl::Defines NeoHookeanBuffers::defines(const Model& model) {
    if (model.neo_hookean_tets.empty()) return {};
    if (!model.has_damping()) return {"NEO_HOOKEAN"};
    return {"NEO_HOOKEAN", "DAMPED"};
}

void NeoHookeanBuffers::bind_tets() const {
    if (!tets_.empty()) tet_texels_.bind(13);
}

void NeoHookeanBuffers::bind() const {
    bind_tets();
    corners_.bind();
}

}  // namespace gelatin::gpu
