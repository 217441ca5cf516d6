#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "gl/buffer.h"
#include "gpu/collision/collision_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The buffers that the stages of gpu::FindProximities pass to one another, in addition to CollisionBuffers,
/// and their results. Sizes are estimates within limits of memory; what does not fit is counted.
struct ProximityBuffers {
    /// The results of query q, node q of SurfaceParts::nodes or edge q - nodes, are starts[q] .. starts[q +
    /// 1] of `proximities`, in ascending order of `second`; those beyond its end are lost.
    gl::Buffer<std::uint32_t> starts;  ///< shape [nodes + edges + 1]
    gl::Buffer<Proximity> proximities;
    gl::Buffer<ProximityCounts> found;  ///< one element: exact, including what was lost

    gl::Buffer<std::uint32_t> surface_nodes;
    gl::Buffer<FaceEdge> face_edges;
    gl::Buffer<glm::uvec2> face_starts;
    gl::BufferTexture surface_node_texels, face_edge_texels, face_start_texels;
    gl::BufferTexture leaf_node_texels, face_box_texels;  // of CollisionBuffers

    gl::Buffer<LeafSearch> searches;        ///< shape [leaves]
    gl::Buffer<NearObject> near_objects;    ///< walks
    gl::Buffer<std::uint32_t> near_leaves;  ///< nodes of the face trees
    gl::BufferTexture near_leaf_texels;
    /// Of nodes, and of edges: see shaders/sim/proximity/proximity_task.glsl.
    struct Tasks {
        gl::Buffer<std::uint32_t> leaves;
        gl::Buffer<glm::uvec4> hits;
        explicit Tasks(std::size_t capacity) : leaves(capacity), hits(capacity) {}
    };
    Tasks node_tasks, edge_tasks;
    gl::Buffer<std::uint32_t> group_sums;
    std::uint32_t leaf_count = 0, node_count = 0, query_count = 0;

    /// @param capacity of `proximities`; empty: by the number of nodes and edges
    ProximityBuffers(const Model& model, const CollisionBuffers& collision,
                     std::optional<std::size_t> capacity = {});

    /// For programs that include sim/proximity/proximities.glsl: what never changes of the surface, and the
    /// boxes of faces.
    void bind_surface(const gl::Program& program) const;
};

}  // namespace gelatin::gpu
