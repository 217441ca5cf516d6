#include "gpu/collision/self_collision_buffers.h"

namespace gelatin::gpu {
namespace {

gl::Buffer<std::uint32_t> zeros(std::size_t size) {
    gl::Buffer<std::uint32_t> buffer(size);
    buffer.fill(0);
    return buffer;
}

}  // namespace

SelfCollisionBuffers::SelfCollisionBuffers(const Model& model)
    : rest_offsets(std::span<const glm::vec4>(model.rest_shapes.offsets)),
      clearances(std::span<const float>(model.rest_shapes.clearances)),
      rest_offset_texels(rest_offsets, gl::TexelFormat::rgba32f),
      clearance_texels(clearances, gl::TexelFormat::r32f),
      fits(model.objects.size()),
      fit_texels(fits, gl::TexelFormat::rgba32f),
      last_restless(zeros(model.objects.size())),
      restless(model.faces.size()),
      is_calm(model.faces.size()),
      contact_counts(zeros(model.faces.size())),
      colliding(model.faces.size()),
      face_count(static_cast<std::uint32_t>(model.faces.size())) {}

gl::Defines self_collision_defines(const Model& model) {
    return model.rest_shapes.objects.empty() ? gl::Defines{} : gl::Defines{"SELF_COLLISION"};
}

}  // namespace gelatin::gpu
