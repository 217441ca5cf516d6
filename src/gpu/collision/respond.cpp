#include "gpu/collision/respond.h"

#include "model/solver.h"

namespace gelatin::gpu {

Respond::Respond(const Model& model, const CollisionBuffers& collision, const CollisionSettings& settings)
    : share_program_(gl::Program::compute("sim/collision/count_shares.comp")),
      patch_program_(gl::Program::compute("sim/collision/sum_contacts.comp")),
      approach_program_(gl::Program::compute("sim/collision/sum_contacts.comp", {"APPROACHING"})),
      plan_program_(gl::Program::compute("sim/collision/plan_responses.comp")),
      respond_program_(gl::Program::compute("sim/collision/respond.comp")),
      node_shares_(model.positions.size()),
      node_share_texels_(node_shares_, gl::TexelFormat::r32ui),
      patches_(collision.object_pairs.size()),
      approaches_(collision.object_pairs.size()),
      responses_(collision.object_pairs.size()) {
    plan_program_.set("friction", static_cast<float>(settings.friction));
    plan_program_.set("restitution", static_cast<float>(settings.restitution));
}

void Respond::run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& previous,
                  const NodeBuffers& current, double step) const {
    using Work = CollisionBuffers::Work;
    collision.bind_pairs();
    collision.bind_node_faces();
    collision.face_collisions.bind_storage(4);
    model.face_texels.bind(4);
    node_shares_.bind_storage(3);
    collision.run(share_program_, Work::nodes);
    gl::barrier(gl::Barrier::texture_fetch);

    node_share_texels_.bind(5);
    current.position_texels.bind(0);
    current.velocity_texels.bind(1);
    model.faces.bind_storage(3);
    patches_.bind_storage(5);
    collision.run(patch_program_, Work::pair_groups);
    gl::barrier(gl::Barrier::storage);

    approaches_.bind_storage(7);
    collision.run(approach_program_, Work::pair_groups);
    gl::barrier(gl::Barrier::storage);

    responses_.bind_storage(3);
    plan_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    collision.run(plan_program_, Work::pairs);
    gl::barrier(gl::Barrier::storage);

    previous.position_texels.bind(0);
    current.positions.bind_storage(5);
    current.velocities.bind_storage(7);
    respond_program_.set("time_step", static_cast<float>(step));
    collision.run(respond_program_, Work::nodes);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
