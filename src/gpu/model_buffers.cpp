#include "gpu/model_buffers.h"

namespace gelatin::gpu {

ModelBuffers::ModelBuffers(const Model& model)
    : half_springs(std::span(model.half_springs.pairs)),
      stiffnesses(std::span(model.half_springs.stiffness)),
      slice_starts(std::span(model.half_springs.slice_starts)),
      half_spring_texels(half_springs, gl::TexelFormat::rgba32ui),
      stiffness_texels(stiffnesses, gl::TexelFormat::rg32f),
      slice_start_texels(slice_starts, gl::TexelFormat::r32ui),
      colliders(std::span(model.colliders)),
      node_count(model.node_count()),
      collider_count(static_cast<std::uint32_t>(model.colliders.size())),
      gravity(model.gravity) {}

void ModelBuffers::bind_half_springs() const {
    half_spring_texels.bind(4);
    stiffness_texels.bind(5);
    slice_start_texels.bind(6);
}

}  // namespace gelatin::gpu
