#include "gpu/descent/rigid_move.h"

#include <vector>

#include "gpu/chunks.h"
#include "model/shared_constants.h"
#include "model/solver.h"

namespace gelatin::gpu {
namespace {

gl::Defines with(gl::Defines defines, const char* another) {
    defines.emplace_back(another);
    return defines;
}

}  // namespace

RigidMove::RigidMove(const Model& model, const StepObjective& objective, const ColliderContacts& contacts)
    : sum_program_(
          gl::Program::compute("sim/descent/sum_rigid_motions.comp", ModelBuffers::collider_defines(model))),
      motion_program_(gl::Program::compute("sim/descent/sum_rigid_motions.comp",
                                           with(ModelBuffers::collider_defines(model), "OBJECTS"))),
      move_program_(gl::Program::compute("sim/descent/move_bodies.comp")),
      last_move_program_(gl::Program::compute("sim/descent/move_bodies.comp",
                                              with(ModelBuffers::collider_defines(model), "LAST"))),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      motions_(model.objects.size()) {
    const std::vector<Chunk> chunks = make_chunks(model, &ModelObject::nodes);
    chunks_ = gl::Buffer<Chunk>(chunks);
    chunk_starts_ = {gpu::chunk_starts(chunks, model.objects.size()), gl::TexelFormat::r32ui};
    rigid_sums_ = gl::Buffer<glm::dvec4>(rigid_sums::kRigidSums * chunks.size());
    for (const gl::Program* program : {&sum_program_, &motion_program_}) {
        program->bind("chunk_starts", chunk_starts_);
        program->bind("Sums", rigid_sums_);
        contacts.bind(*program);
    }
    for (const gl::Program* program :
         {&sum_program_, &motion_program_, &move_program_, &last_move_program_}) {
        program->bind("start_positions", objective.start_texels);
        program->bind("targets", objective.target_texels);
        program->bind("Chunks", chunks_);
        program->bind("Motions", motions_);
    }
    last_move_program_.bind("ObjectContacts", contacts.objects);
}

void RigidMove::begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                      double step) const {
    for (const gl::Program* program : {&sum_program_, &move_program_, &last_move_program_})
        program->set("time_step", static_cast<float>(step));
    for (const gl::Program* program :
         {&sum_program_, &motion_program_, &move_program_, &last_move_program_}) {
        program->bind("positions", current.position_texels);
        program->bind("start_velocities", previous.velocity_texels);
    }
    for (const gl::Program* program : {&move_program_, &last_move_program_}) {
        program->bind("OutPositions", current.positions);
        program->bind("Velocities", current.velocities);
    }
    model.bind_colliders(last_move_program_);
    last_move_program_.set("contact_distance", static_cast<float>(kContactDistance));
    last_move_program_.set("resting_speed", static_cast<float>(resting_speed(model.gravity, step)));
}

void RigidMove::run(bool is_last) const {
    const auto chunks = static_cast<std::uint32_t>(chunks_.size());
    sum_program_.set("element_count", chunks);
    sum_program_.dispatch(rigid_sums::kLanesAChunk * chunks_.size());
    gl::barrier(gl::Barrier::storage);

    motion_program_.set("element_count", object_count_);
    motion_program_.set("is_last", is_last ? 1u : 0u);
    motion_program_.dispatch(object_count_);
    gl::barrier(gl::Barrier::storage);

    const gl::Program& move = is_last ? last_move_program_ : move_program_;
    move.set("element_count", chunks);
    move.dispatch_groups(chunks_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
