#include "gpu/collision/respond_to_self.h"

#include "model/solver.h"

namespace gelatin::gpu {

RespondToSelf::RespondToSelf(const Model& model, const CollisionSettings& settings)
    : face_program_(gl::Program::compute("sim/collision/respond_to_self.comp")),
      node_program_(gl::Program::compute("sim/collision/respond_to_self.comp", {"NODES"})),
      answers_(2 * model.faces.size()) {
    face_program_.set("friction", static_cast<float>(settings.friction));
    face_program_.set("restitution", static_cast<float>(settings.restitution));
}

void RespondToSelf::run(const ModelBuffers& model, const CollisionBuffers& collision,
                        const SelfCollisionBuffers& self, const NodeBuffers& previous,
                        const NodeBuffers& current, double step) const {
    for (const gl::Program* program : {&face_program_, &node_program_}) {
        collision.bind_node_faces(*program);
        program->bind("ContactCounts", self.contact_counts);
        program->bind("Answers", answers_);
        program->bind("Dispatches", collision.dispatches);
    }
    collision.bind_own_trees(face_program_, model);
    face_program_.bind("positions", current.position_texels);
    face_program_.bind("velocities", current.velocity_texels);
    face_program_.bind("previous_positions", previous.position_texels);
    face_program_.bind("SelfFaces", self.colliding);
    face_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    collision.run(face_program_, dispatch_slots::kSelfFaces);
    gl::barrier(gl::Barrier::storage);

    node_program_.bind("Positions", current.positions);
    node_program_.bind("Velocities", current.velocities);
    collision.run(node_program_, dispatch_slots::kSelfNodes);
}

}  // namespace gelatin::gpu
