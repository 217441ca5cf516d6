#include "gpu/drive/sum_loads.h"

#include <algorithm>

namespace gelatin::gpu {

SumLoads::SumLoads(const Model& model)
    : program_(gl::Program::compute("sim/drive/sum_loads.comp")),
      loaded_nodes_(std::span(model.loads.nodes)),
      node_loads_(std::span(model.loads.entries)),
      factors_(model.loads.spans.size(), 1.0f),
      factor_buffer_(std::span<const float>(factors_)),
      forces_(std::vector<glm::vec4>(model.positions.size(), glm::vec4(0.0f))),
      force_texels_(forces_, gl::TexelFormat::rgba32f) {}

void SumLoads::set_factors(std::span<const float> factors) {
    if (std::equal(factors.begin(), factors.end(), factors_.begin(), factors_.end())) return;
    factors_.assign(factors.begin(), factors.end());
    factor_buffer_.upload(factors);
}

void SumLoads::run(const NodeBuffers& nodes) const {
    nodes.position_texels.bind(0);
    forces_.bind_storage(0);
    loaded_nodes_.bind_storage(1);
    node_loads_.bind_storage(2);
    factor_buffer_.bind_storage(3);
    program_.set("loaded_count", static_cast<std::uint32_t>(loaded_nodes_.size()));
    program_.dispatch(loaded_nodes_.size());
    gl::barrier(gl::Barrier::texture_fetch);
    force_texels_.bind(16);
}

}  // namespace gelatin::gpu
