#pragma once

#include <cstdint>
#include <optional>

namespace gelatin {

/// What to show of the simulation beside the bodies.
struct Overlays {
    /// Boxes of the objects, and of so many levels below them in the trees over their faces; empty: none.
    std::optional<int> box_levels = {};
    bool faces = false;  ///< faces that touch another object
    /// Springs, coloured by strain; this strain, either way, has the full colour, > 0; empty: none.
    std::optional<float> full_strain = {};

    bool any() const { return box_levels || faces || full_strain; }
};

/// What a renderer needs for that: GL buffer objects as in RenderView; 0 where it was not asked for.
struct OverlayView {
    unsigned boxes = 0;  ///< two vec4: lower and upper corner xyz [m]; shape [box_count]
    unsigned shown_boxes =
        0;  ///< two uint: index into boxes, levels below the object's; shape [shown_box_count]
    std::uint32_t box_count = 0;
    std::uint32_t shown_box_count = 0;
    unsigned face_marks = 0;  ///< uint: 1 for a face to be marked, else 0; shape [faces]
    unsigned springs = 0;     ///< Spring (two nodes, rest length [m], stiffness); shape [spring_count]
    std::uint32_t spring_count = 0;
    float full_strain = 0.0f;
};

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
    OverlayView overlay{};
};

}  // namespace gelatin
