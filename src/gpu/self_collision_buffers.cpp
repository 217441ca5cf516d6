#include "gpu/self_collision_buffers.h"

namespace gelatin::gpu {
namespace {

std::vector<std::uint32_t> no_contacts(const Model& model) {
    return std::vector<std::uint32_t>(model.faces.size(), 0);
}

}  // namespace

SelfCollisionBuffers::SelfCollisionBuffers(const Model& model)
    : rest_offsets(std::span<const glm::vec4>(model.rest_shapes.offsets)),
      clearances(std::span<const float>(model.rest_shapes.clearances)),
      rest_offset_texels(rest_offsets, gl::TexelFormat::rgba32f),
      clearance_texels(clearances, gl::TexelFormat::r32f),
      fits(model.objects.size()),
      restless(model.faces.size()),
      is_calm(model.faces.size()),
      contact_counts(std::span<const std::uint32_t>(no_contacts(model))),
      colliding(model.faces.size()),
      face_count(static_cast<std::uint32_t>(model.faces.size())) {}

}  // namespace gelatin::gpu
