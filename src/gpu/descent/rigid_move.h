#pragma once

#include <glm/vec4.hpp>

#include "gl/program.h"
#include "gpu/descent/collider_contacts.h"
#include "gpu/descent/step_objective.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// A move of block descent: each body that nothing holds makes Newton's step along rigid motions:
/// shaders/sim/descent/sum_rigid_motions.comp, move_bodies.comp. CPU twin: cpu::RigidMove.
class RigidMove {
public:
    RigidMove(const Model& model, const StepObjective& objective, const ColliderContacts& contacts);

    const gl::Buffer<Chunk>& chunks() const { return chunks_; }  ///< of nodes
    /// Of each object in them, and the end.
    const gl::TexelTable<std::uint32_t>& chunk_starts() const { return chunk_starts_; }

    /// To be called when a step of `step` seconds begins.
    void begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
               double step) const;

    /// Moves all bodies. @param is_last whether no sweep follows: also finds the velocities
    void run(bool is_last) const;

private:
    gl::Program sum_program_, motion_program_, move_program_, last_move_program_;
    std::uint32_t object_count_;
    gl::Buffer<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> chunk_starts_;
    gl::Buffer<glm::dvec4> rigid_sums_;
    gl::Buffer<RigidMotion> motions_;
};

}  // namespace gelatin::gpu
