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
      force_texels_(forces_, gl::TexelFormat::rgba32f) {
    program_.bind("LoadForces", forces_);
    program_.bind("LoadedNodes", loaded_nodes_);
    program_.bind("NodeLoads", node_loads_);
    program_.bind("Factors", factor_buffer_);
    program_.set("loaded_count", static_cast<std::uint32_t>(loaded_nodes_.size()));
}

void SumLoads::set_factors(std::span<const float> factors) {
    if (std::equal(factors.begin(), factors.end(), factors_.begin(), factors_.end())) return;
    factors_.assign(factors.begin(), factors.end());
    factor_buffer_.upload(factors);
}

void SumLoads::run(const NodeBuffers& nodes) const {
    program_.bind("positions", nodes.position_texels);
    program_.dispatch(loaded_nodes_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
