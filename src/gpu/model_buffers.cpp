#include "gpu/model_buffers.h"

#include <string>

namespace gelatin::gpu {
namespace {

glm::uvec4 count_up_to_kind(const std::vector<Collider>& colliders) {
    glm::uvec4 ends(0);
    for (const Collider& collider : colliders) {
        for (std::uint32_t kind = collider.kind; kind < 4; ++kind) ++ends[static_cast<int>(kind)];
    }
    return ends;
}

}  // namespace

ModelBuffers::ModelBuffers(const Model& model)
    : half_springs(model.half_springs.pairs, gl::TexelFormat::rgba32ui),
      stiffnesses(model.half_springs.stiffness, gl::TexelFormat::rg32f),
      slice_starts(model.half_springs.slice_starts, gl::TexelFormat::r32ui),
      neo_hookean(model),
      volume_term(model),
      faces(std::span(model.faces)),
      face_texels(faces, gl::TexelFormat::rgba32ui),
      colliders(model.colliders, gl::TexelFormat::rgba32f),
      node_count(model.node_count()),
      collider_ends(count_up_to_kind(model.colliders)),
      gravity(model.gravity) {}

gl::Defines ModelBuffers::collider_defines(const Model& model) {
    unsigned kinds = 0;
    for (const Collider& collider : model.colliders) kinds |= 1u << collider.kind;
    return {"COLLIDER_KINDS " + std::to_string(kinds)};
}

void ModelBuffers::bind_half_springs(const gl::Program& program) const {
    program.bind("half_springs", half_springs);
    program.bind("stiffnesses", stiffnesses);
    program.bind("slice_starts", slice_starts);
}

void ModelBuffers::bind_colliders(const gl::Program& program) const {
    program.bind("colliders", colliders);
    program.set("collider_ends", collider_ends);
}

}  // namespace gelatin::gpu
