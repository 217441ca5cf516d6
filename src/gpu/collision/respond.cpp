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
    for (const gl::Program* program :
         {&share_program_, &patch_program_, &approach_program_, &plan_program_, &respond_program_})
        collision.bind_pairs(*program);
    for (const gl::Program* program :
         {&share_program_, &patch_program_, &approach_program_, &respond_program_})
        program->bind("FaceCollisions", collision.face_collisions);
    for (const gl::Program* program : {&share_program_, &respond_program_}) {
        collision.bind_node_faces(*program);
        program->bind("faces", model.face_texels);
    }
    for (const gl::Program* program :
         {&patch_program_, &approach_program_, &plan_program_, &respond_program_})
        program->bind("ContactPatches", patches_);

    share_program_.bind("NodeShares", node_shares_);
    collision.run(share_program_, dispatch_slots::kNodes);
    gl::barrier(gl::Barrier::texture_fetch);

    for (const gl::Program* program : {&patch_program_, &approach_program_}) {
        program->bind("node_shares", node_share_texels_);
        program->bind("positions", current.position_texels);
        program->bind("velocities", current.velocity_texels);
        program->bind("Faces", model.faces);
    }
    collision.run(patch_program_, dispatch_slots::kPairGroups);
    gl::barrier(gl::Barrier::storage);

    approach_program_.bind("Approaches", approaches_);
    collision.run(approach_program_, dispatch_slots::kPairGroups);
    gl::barrier(gl::Barrier::storage);

    plan_program_.bind("Approaches", approaches_);
    plan_program_.bind("Responses", responses_);
    plan_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
    collision.run(plan_program_, dispatch_slots::kPairs);
    gl::barrier(gl::Barrier::storage);

    respond_program_.bind("Responses", responses_);
    respond_program_.bind("node_shares", node_share_texels_);
    respond_program_.bind("previous_positions", previous.position_texels);
    respond_program_.bind("Positions", current.positions);
    respond_program_.bind("Velocities", current.velocities);
    respond_program_.set("time_step", static_cast<float>(step));
    collision.run(respond_program_, dispatch_slots::kNodes);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
