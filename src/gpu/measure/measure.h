#pragma once

#include <deque>
#include <vector>

#include "gl/program.h"
#include "gl/readback.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/self_collision_buffers.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "gpu/proximity/proximity_buffers.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Sums over each object without stalling the GPU: shaders/sim/measure/measure_nodes.comp and
/// measure_faces.comp compute partial sums, which are read back through a fence; the host adds them up in
/// double precision.
class Measure {
public:
    /// @param self_collision whether `begin` is given the buffers of self-collision
    explicit Measure(const Model& model, bool self_collision = false);

    /// How near to a collider nodes of each object touch it [m]; kContactDistance until it is called.
    void set_contact_distances(const std::vector<float>& distances) {
        contact_distances_ = {distances, gl::TexelFormat::r32f};
    }

    /// @param collision null if nothing can collide
    /// @param self null if nothing collides with itself
    /// @param near null without a proximity radius
    void begin(const ModelBuffers& model, const NodeBuffers& nodes,
               const CollisionBuffers* collision = nullptr, const SelfCollisionBuffers* self = nullptr,
               const ProximityBuffers* near = nullptr);
    /// The oldest pending measurement; waits for it if necessary.
    Measurement end();

private:
    void count_colliding_faces(const CollisionBuffers& collision, const SelfCollisionBuffers* self);

    gl::Program node_program_, face_program_, colliding_program_;
    std::vector<Chunk> node_chunks_, face_chunks_;
    gl::TexelTable<float> contact_distances_;
    gl::Buffer<Chunk> node_chunk_buffer_, face_chunk_buffer_;
    gl::Buffer<NodeSums> node_sums_;
    gl::Buffer<float> volumes_;
    gl::Buffer<std::uint32_t> colliding_;
    gl::Readback readback_;
    std::deque<std::uint32_t> proximity_capacities_;  // of the pending measurements; 0: no proximities
    std::size_t object_count_;
};

}  // namespace gelatin::gpu
