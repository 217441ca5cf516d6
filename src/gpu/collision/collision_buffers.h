#pragma once

#include <glm/vec4.hpp>

#include "gelatin/scene.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/collision/tree_buffers.h"
#include "gpu/model_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// True where faces are sought in trees, else by brute force.
constexpr bool walks_trees(BroadPhase broad_phase) {
    return broad_phase == BroadPhase::hierarchy || broad_phase == BroadPhase::depth;
}

/// What the stages of collision hand to one another, for any number of objects. Sizes are for what
/// may happen, up to limits of memory; what does not fit is counted, never forgotten in silence.
struct CollisionBuffers {
    TreeBuffers face_trees;                  ///< one an object
    gl::Buffer<Box> face_boxes;              ///< shape [faces]
    gl::Buffer<BoundingBox> bounding_boxes;  ///< shape [objects]

    gl::Buffer<PairRow> pair_rows;  ///< shape [objects]
    gl::Buffer<ObjectPair> object_pairs;
    gl::Buffer<std::uint32_t> candidates;       ///< faces
    gl::Buffer<FacePair> face_pairs;            ///< whose boxes meet
    gl::Buffer<std::uint32_t> face_collisions;  ///< two bits a face, by pair: a FaceContact
    gl::Buffer<Dispatch> dispatches;            ///< see shaders/sim/collision/pairs.glsl

    gl::Buffer<std::uint32_t> node_face_starts, node_faces;
    gl::BufferTexture node_face_start_texels, node_face_texels;
    std::uint32_t object_count = 0;

    /// @throws InvalidInput for more objects and faces than their entries can be counted for.
    explicit CollisionBuffers(const Model& model);

    /// Binds what sim/collision/pairs.glsl reads and writes: storage 0, 1, 2 and 6.
    void bind_pairs() const;
    /// Binds what sim/collision/node_faces.glsl reads: texture units 2 and 3.
    void bind_node_faces() const;

    /// The dispatches of sim/collision/pairs.glsl.
    enum class Work : unsigned {
        entries,
        tests,
        face_pairs,
        pairs,
        pair_groups,
        nodes,
        scan,
        losses,
        restless,
        self_pairs,
        self_faces,
        self_nodes,
        fit_sums,
        fits,
        restless_chunks,
        near_objects,
        near_leaves,
        node_tasks,
        edge_tasks,
        count
    };
    /// Runs `program` over what the GPU itself has counted.
    void run(const gl::Program& program, Work work) const;
};

}  // namespace gelatin::gpu
