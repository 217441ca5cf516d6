#include "gpu/view/mark_faces.h"

namespace gelatin::gpu {

MarkFaces::MarkFaces(const Model& model)
    : program_(gl::Program::compute("sim/view/mark_faces.comp", self_collision_defines(model))) {}

void MarkFaces::run(const ModelBuffers& model, const CollisionBuffers& collision,
                    const SelfCollisionBuffers* self, const gl::Buffer<std::uint32_t>& marks) const {
    collision.bind_pairs();
    model.faces.bind_storage(3);
    collision.face_collisions.bind_storage(4);
    marks.bind_storage(5);
    if (self != nullptr) self->contact_counts.bind_storage(7);
    program_.set("face_count", static_cast<std::uint32_t>(model.faces.size()));
    program_.dispatch(model.faces.size());
    gl::barrier(gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
