#pragma once

#include <cstdint>

namespace gelatin {

/// What a renderer needs to draw the deformable bodies straight from the simulation's buffers: names of GL
/// buffer objects (std430) in the simulator's context, and counts. Valid until the simulator's next frame;
/// with the CPU backend, which simulates elsewhere, until the next view.
struct RenderView {
    unsigned node_positions = 0;    ///< vec4: xyz [m], inverse mass; shape [nodes]
    unsigned surface_vertices = 0;  ///< SurfaceVertex (node, object, ...); shape [vertices]
    unsigned vertex_normals = 0;    ///< vec4: unit normal xyz, 0; shape [vertices]
    unsigned triangles = 0;         ///< three uint indices into surface_vertices; shape [faces]
    std::uint32_t node_count = 0;
    std::uint32_t vertex_count = 0;
    std::uint32_t face_count = 0;
    std::uint32_t object_count = 0;
    float box_min[3] = {};  ///< what holds all nodes [m]
    float box_max[3] = {};
    bool box_is_late = false;  ///< the box is that of a view before: from a GPU it comes without a wait
};

}  // namespace gelatin
