#include "gpu/proximity/proximity_buffers.h"

#include <algorithm>

namespace gelatin::gpu {
namespace {

// How many elements a buffer has: for what usually happens, and within limits of memory.
struct Capacity {
    std::size_t each, least, most;

    std::size_t operator()(std::size_t count) const { return std::clamp(count * each, least, most); }
};
constexpr std::size_t kMostInvocations = 65535 * 64;             // of a dispatch in one dimension
constexpr Capacity kNearObjects{8, 1u << 16, kMostInvocations};  // a leaf; 1 to 64 MB
constexpr Capacity kNearLeaves{64, 1u << 20, 1u << 24};          // a leaf; 4 to 64 MB
constexpr Capacity kTasks{8, 1u << 18, kMostInvocations};        // a node or edge; 5 to 84 MB
constexpr Capacity kProximities{8, 1u << 17, 1u << 20};          // a node or edge; 6 to 50 MB

constexpr ProximityCounts kNothing{0, 0, 0x7F800000, 0};  // nearest at infinity, until it is sought

}  // namespace

ProximityBuffers::ProximityBuffers(const Model& model, const CollisionBuffers& collision,
                                   std::optional<std::size_t> capacity)
    : starts(model.surface_parts.nodes.size() + model.surface_parts.edges.size() + 1),
      proximities(capacity.value_or(kProximities(starts.size()))),
      found(std::span(&kNothing, 1)),
      surface_nodes(std::span(model.surface_parts.nodes)),
      face_edges(std::span(model.surface_parts.edges)),
      face_starts(std::span(model.surface_parts.face_starts)),
      surface_node_texels(surface_nodes, gl::TexelFormat::r32ui),
      face_edge_texels(face_edges, gl::TexelFormat::rgba32ui),
      face_start_texels(face_starts, gl::TexelFormat::rg32ui),
      leaf_node_texels(collision.face_trees.level_nodes, gl::TexelFormat::r32ui),
      face_box_texels(collision.face_boxes, gl::TexelFormat::rgba32f),
      searches(model.face_trees.levels[0].size()),
      near_objects(kNearObjects(searches.size())),
      near_leaves(kNearLeaves(searches.size())),
      near_leaf_texels(near_leaves, gl::TexelFormat::r32ui),
      node_tasks(kTasks(surface_nodes.size())),
      edge_tasks(kTasks(face_edges.size())),
      group_sums(starts.size() / packing::kQueriesAGroup + 1),
      leaf_count(static_cast<std::uint32_t>(searches.size())),
      node_count(static_cast<std::uint32_t>(surface_nodes.size())),
      query_count(static_cast<std::uint32_t>(starts.size() - 1)) {}

void ProximityBuffers::bind_surface(const gl::Program& program) const {
    program.bind("face_boxes", face_box_texels);
    program.bind("leaf_nodes", leaf_node_texels);
    program.bind("face_starts", face_start_texels);
    program.bind("surface_nodes", surface_node_texels);
    program.bind("face_edges", face_edge_texels);
}

}  // namespace gelatin::gpu
