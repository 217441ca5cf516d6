#pragma once

#include <glm/vec4.hpp>

#include "gelatin/scene.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/collision/tree_buffers.h"
#include "gpu/model_buffers.h"
#include "model/model.h"
#include "model/shared_constants.h"

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
    gl::Buffer<std::uint32_t> face_collisions;  ///< two bits a face, by pair: a Touch
    gl::Buffer<Dispatch> dispatches;            ///< by dispatch_slots

    gl::Buffer<std::uint32_t> face_views, object_views;  ///< see shaders/sim/depth/hidden.glsl
    gl::BufferTexture face_view_texels, object_view_texels;

    gl::Buffer<std::uint32_t> node_face_starts, node_faces;
    gl::BufferTexture node_face_start_texels, node_face_texels;
    std::uint32_t object_count = 0;

    /// @throws InvalidInput for more objects and faces than their entries can be counted for.
    explicit CollisionBuffers(const Model& model);

    /// For programs that include sim/collision/pairs.glsl.
    void bind_pairs(const gl::Program& program) const;
    /// For programs that include sim/collision/node_faces.glsl.
    void bind_node_faces(const gl::Program& program) const;
    /// For programs that include sim/collision/own_tree.glsl.
    void bind_own_trees(const gl::Program& program, const ModelBuffers& model) const;
    /// For programs that include sim/depth/hidden.glsl.
    void bind_hidden(const gl::Program& program) const;

    /// Runs `program` over what the GPU itself has counted. @param slot one of dispatch_slots
    void run(const gl::Program& program, std::uint32_t slot) const;
};

}  // namespace gelatin::gpu
