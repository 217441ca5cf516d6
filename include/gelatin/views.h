#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace gelatin {

/// What colours can tell about a body (docs/physics.md, "What colours show").
enum class Quantity {
    stretch,  ///< the largest principal stretch, 1 at rest
    stress,   ///< von Mises' stress [Pa]
    speed,    ///< [m/s]
};

struct ColorMap {
    Quantity quantity = Quantity::stress;
    std::optional<float> full = {};  ///< what has the last colour; empty: follows what there is
};

/// Cuts all bodies open: what lies on the side that the normal points to is taken away.
struct CutPlane {
    float normal[3] = {0.0f, 0.0f, 1.0f};  ///< of any length but 0
    /// From the origin along the normal [m]; empty: through the middle of where the bodies start.
    std::optional<float> offset = {};
};

/// What to show of the simulation beside the bodies.
struct Overlays {
    /// Boxes of the objects, and of so many levels below them in the trees over their faces; empty: none.
    std::optional<int> box_levels = {};
    bool lowest_boxes_alone = false;  ///< of these the last level and no other
    bool faces = false;               ///< faces that touch another object
    /// Springs, coloured by strain; this strain, either way, has the full colour, > 0; empty: none.
    std::optional<float> full_strain = {};
    std::optional<ColorMap> color_map = {};  ///< not together with springs, which have colours of their own
    std::optional<CutPlane> cut = {};
    /// Arrows as long as surface nodes go in this time [s], > 0; empty: none.
    std::optional<float> arrow_time = {};
    bool objects = false;    ///< each object in a colour of its own, and its name
    bool wireframe = false;  ///< the edges of the surfaces

    bool any() const {
        return box_levels || faces || full_strain || color_map || cut || arrow_time || objects || wireframe;
    }
};

/// What a renderer needs for a plane that cuts bodies open. Names are of GL buffer objects, as in RenderView.
struct CutView {
    float plane[4] = {};       ///< unit normal, minus the offset [m]: positive where bodies are cut away
    unsigned tets = 0;         ///< four uint indices of nodes; shape [tet_count]
    unsigned tet_objects = 0;  ///< uint; shape [tet_count]
    std::uint32_t tet_count = 0;
};

struct ColorMapView {
    Quantity quantity = Quantity::stress;
    unsigned node_values = 0;       ///< float; shape [nodes]
    unsigned tet_values = 0;        ///< float, the tets being those of CutView; shape [tets]
    float low = 0.0f, full = 1.0f;  ///< what has the first colour, and the last
};

struct ArrowView {
    unsigned nodes = 0;       ///< uint; shape [count]
    unsigned velocities = 0;  ///< vec4: xyz [m/s]; shape [nodes]
    std::uint32_t count = 0;
    float time = 0.0f;  ///< [s]
};

struct ObjectView {
    unsigned roots = 0;  ///< uint: the object's box among OverlayView::boxes; shape [objects]
    std::span<const std::string> names;
};

/// What a renderer needs for overlays: GL buffer objects as in RenderView; 0 or empty where it was not asked
/// for.
struct OverlayView {
    unsigned boxes = 0;  ///< two vec4: lower and upper corner xyz [m]; shape [box_count]
    unsigned shown_boxes =
        0;  ///< two uint: index into boxes, levels below the first shown; shape [shown_box_count]
    std::uint32_t box_count = 0;
    std::uint32_t shown_box_count = 0;
    unsigned face_marks = 0;  ///< uint: 1 for a face to be marked, else 0; shape [faces]
    unsigned springs = 0;     ///< Spring (two nodes, rest length [m], stiffness); shape [spring_count]
    std::uint32_t spring_count = 0;
    float full_strain = 0.0f;
    std::optional<ColorMapView> color_map = {};
    std::optional<CutView> cut = {};
    std::optional<ArrowView> arrows = {};
    std::optional<ObjectView> objects = {};
    bool wireframe = false;
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
