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
    using Work = CollisionBuffers::Work;
    current.position_texels.bind(0);
    current.velocity_texels.bind(1);
    collision.bind_node_faces();
    collision.face_trees.node_texels.bind(4);
    collision.face_trees.box_texels.bind(5);
    collision.face_trees.root_texels.bind(6);
    model.face_texels.bind(7);
    previous.position_texels.bind(8);
    self.contact_counts.bind_storage(1);
    answers_.bind_storage(2);
    collision.face_boxes.bind_storage(3);
    self.colliding.bind_storage(4);
    collision.dispatches.bind_storage(6);
    face_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    collision.run(face_program_, Work::self_faces);
    gl::barrier(gl::Barrier::storage);

    current.positions.bind_storage(5);
    current.velocities.bind_storage(7);
    collision.run(node_program_, Work::self_nodes);
}

}  // namespace gelatin::gpu
