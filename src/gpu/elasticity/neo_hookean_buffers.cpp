#include "gpu/elasticity/neo_hookean_buffers.h"

#include <numeric>

#include "model/elasticity/tet_strips.h"

namespace gelatin::gpu {
namespace {

std::vector<std::uint32_t> all_nodes(const Model& model) {
    std::vector<std::uint32_t> rows(model.node_count());
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
}

}  // namespace

NeoHookeanBuffers::NeoHookeanBuffers(const Model& model, std::span<const std::uint32_t> rows) {
    if (model.neo_hookean_tets.empty()) return;
    const NodeTets none;
    const StripSlices<NeoHookeanStep> packed = pack_neo_hookean_strips({model, none}, rows);
    strips_ = {packed.steps, gl::TexelFormat::rgba32ui};
    slice_starts_ = {packed.slice_starts, gl::TexelFormat::r32ui};
}

NeoHookeanBuffers::NeoHookeanBuffers(const Model& model) : NeoHookeanBuffers(model, all_nodes(model)) {}

gl::Defines NeoHookeanBuffers::defines(const Model& model) {
    if (model.neo_hookean_tets.empty()) return {};
    if (!model.has_damping()) return {"NEO_HOOKEAN"};
    return {"NEO_HOOKEAN", "DAMPED"};
}

void NeoHookeanBuffers::bind(const gl::Program& program) const {
    if (strips_.is_empty()) return;
    program.bind("neo_hookean_strips", strips_);
    program.bind("neo_hookean_starts", slice_starts_);
}

}  // namespace gelatin::gpu
