#pragma once

#include "gl/program.h"
#include "gpu/collision_buffers.h"
#include "gpu/node_buffers.h"
#include "gpu/self_collision_buffers.h"

namespace gelatin::gpu {

/// The faces that touch others of their own object: shaders/sim/fit_rest_shapes.comp,
/// list_restless_faces.comp, walk_own_trees.comp, test_own_face_pairs.comp. CPU twin: cpu::SelfCollision.
class FindSelfCollisions {
public:
    /// @throws InvalidInput for more faces than one dispatch goes through
    explicit FindSelfCollisions(const Model& model);

    /// Ends with the barriers that the next stage needs. @pre the boxes are those of `nodes`
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const SelfCollisionBuffers& self,
             const NodeBuffers& nodes) const;

private:
    void fit(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const;

    gl::Program sum_program_, fit_program_, list_program_, walk_program_, test_program_;
    gl::Buffer<Chunk> chunks_;
    gl::Buffer<std::uint32_t> chunk_starts_;  // of each object, and the end
    gl::BufferTexture chunk_start_texels_;
    gl::Buffer<RestShape> rest_shapes_;
    gl::Buffer<FitSums> sums_;  // of each chunk
};

}  // namespace gelatin::gpu
