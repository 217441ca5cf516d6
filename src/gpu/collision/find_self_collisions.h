#pragma once

#include "gl/program.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/self_collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// The faces that touch others of their own object. Only shaders/sim/collision/find_restless_objects.comp
/// runs for bodies that are hardly deformed; then list_restless_chunks.comp, fit_rest_shapes.comp,
/// list_restless_faces.comp, walk_own_trees.comp, test_own_face_pairs.comp. CPU twin:
/// cpu::FindSelfCollisions.
class FindSelfCollisions {
public:
    /// @throws InvalidInput for more faces or chunks than one dispatch can process
    explicit FindSelfCollisions(const Model& model);

    /// Ends with the barriers that the next stage needs. @pre the boxes are those of `nodes`
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const SelfCollisionBuffers& self,
             const NodeBuffers& nodes);

private:
    void find_restless_objects(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const;
    void fit(const CollisionBuffers& collision, const SelfCollisionBuffers& self) const;
    void list_restless_faces(const ModelBuffers& model, const CollisionBuffers& collision,
                             const SelfCollisionBuffers& self) const;
    void find_contacts(const ModelBuffers& model, const CollisionBuffers& collision,
                       const SelfCollisionBuffers& self) const;

    gl::Program object_program_, chunk_program_, sum_program_, fit_program_, list_program_, walk_program_,
        test_program_;
    gl::Buffer<Chunk> chunks_;  // of nodes, then of faces
    std::uint32_t node_chunk_count_ = 0;
    gl::BufferTexture chunk_texels_;
    gl::Buffer<std::uint32_t> chunk_starts_;  // of each object's nodes, and the end
    gl::BufferTexture chunk_start_texels_;
    gl::Buffer<RestShape> rest_shapes_;
    gl::Buffer<FitSums> sums_;                                       // of each chunk of nodes
    gl::Buffer<std::uint32_t> node_chunks_, face_chunks_, objects_;  // that are restless
    std::uint32_t step_number_ = 0;
};

}  // namespace gelatin::gpu
