#include "gpu/view/mark_faces.h"

namespace gelatin::gpu {

MarkFaces::MarkFaces(const Model& model)
    : program_(gl::Program::compute("sim/view/mark_faces.comp", self_collision_defines(model))) {}

void MarkFaces::run(const ModelBuffers& model, const CollisionBuffers& collision,
                    const SelfCollisionBuffers* self, const gl::Buffer<std::uint32_t>& marks) const {
    collision.bind_pairs(program_);
    program_.bind("Faces", model.faces);
    program_.bind("FaceCollisions", collision.face_collisions);
    program_.bind("Marks", marks);
    if (self != nullptr) program_.bind("ContactCounts", self->contact_counts);
    program_.set("face_count", static_cast<std::uint32_t>(model.faces.size()));
    program_.dispatch(model.faces.size());
    gl::barrier(gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
