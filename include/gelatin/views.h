#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace gelatin {

/// What colours can show of a body (docs/physics.md, "What colours show").
enum class Quantity {
    stretch,  ///< the largest principal stretch, 1 at rest
    stress,   ///< von Mises' stress [Pa]
    speed,    ///< [m/s]
    /// Normal force of contacts at a node over its share of the surface [Pa]; by the implicit solver on the
    /// CPU, or contact.
    pressure,
};

struct ColorMap {
    Quantity quantity = Quantity::stress;
    std::optional<float> full = {};  ///< the value with the last colour; empty: adapts to the values
};

/// Cuts all bodies open: removes what lies on the side to which the normal points.
struct CutPlane {
    float normal[3] = {0.0f, 0.0f, 1.0f};  ///< of any length but 0
    /// Distance from the origin along the normal [m]; empty: through the centre of the bodies at the start.
    std::optional<float> offset = {};
};

/// Arrows of what contacts exert on nodes, normal and friction together; by the implicit solver on the CPU,
/// or contact.
struct ForceArrows {
    std::optional<float> scale =
        {};  ///< length of an arrow over its force [m/N]; empty: adapts to the forces
};

/// What to show of the simulation in addition to the bodies.
struct Overlays {
    /// Boxes of the objects, and this many levels below them in the trees over their faces; empty: none.
    std::optional<int> box_levels = {};
    bool lowest_boxes_alone = false;  ///< only the last of these levels
    bool faces = false;               ///< faces that touch another object
    /// Springs, coloured by strain. This strain, compressed or stretched, has the full colour, > 0; empty:
    /// none.
    std::optional<float> full_strain = {};
    std::optional<ColorMap> color_map = {};  ///< not together with springs, which have their own colours
    std::optional<CutPlane> cut = {};
    /// Arrows, as long as the displacement of a surface node in this time [s], > 0; empty: none.
    std::optional<float> arrow_time = {};
    std::optional<ForceArrows> contact_forces = {};
    bool objects = false;    ///< each object in its own colour, with its name
    bool wireframe = false;  ///< the edges of the surfaces
    /// Where attachments hold bodies, and the axes of joints. Of a recording, those that cannot break.
    bool attachments = false;
    bool bones = false;  ///< the bones of skeletons, and the nodes that they carry

    bool any() const {
        return box_levels || faces || full_strain || color_map || cut || arrow_time || contact_forces ||
               objects || wireframe || attachments || bones;
    }
};

/// What a renderer needs for a plane that cuts bodies open. Integers are names of GL buffer objects, as in
/// RenderView.
struct CutView {
    float plane[4] = {};       ///< unit normal, minus the offset [m]: positive where bodies are removed
    unsigned tets = 0;         ///< four uint indices of nodes; shape [tet_count]
    unsigned tet_objects = 0;  ///< uint; shape [tet_count]
    std::uint32_t tet_count = 0;
};

struct ColorMapView {
    Quantity quantity = Quantity::stress;
    unsigned node_values = 0;       ///< float; shape [nodes]
    unsigned tet_values = 0;        ///< float, the tets being those of CutView; shape [tets]
    float low = 0.0f, full = 1.0f;  ///< the values with the first and the last colour
};

struct ArrowView {
    unsigned nodes = 0;    ///< uint; shape [count]
    unsigned vectors = 0;  ///< vec4: xyz, a velocity [m/s] or a force [N]; shape [nodes]
    std::uint32_t count = 0;
    float scale = 0.0f;  ///< length of an arrow over that of its vector [s] or [m/N]
};

struct ObjectView {
    unsigned roots = 0;  ///< uint: the object's box among OverlayView::boxes; shape [objects]
    std::span<const std::string> names;
};

/// What a renderer needs for overlays: GL buffer objects as in RenderView; 0 or empty for overlays that were
/// not requested.
struct OverlayView {
    unsigned node_positions =
        0;  ///< vec4: xyz [m], of all nodes, which surfaces may not name; shape [node_count]
    std::uint32_t node_count = 0;
    unsigned boxes = 0;  ///< two vec4: lower and upper corner xyz [m]; shape [box_count]
    unsigned shown_boxes =
        0;  ///< two uint: index into boxes, levels below the first shown; shape [shown_box_count]
    std::uint32_t box_count = 0;
    std::uint32_t shown_box_count = 0;
    unsigned face_marks = 0;  ///< uint: 1 for a marked face, else 0; shape [faces]
    unsigned springs = 0;     ///< Spring (two nodes, rest length [m], stiffness); shape [spring_count]
    std::uint32_t spring_count = 0;
    float full_strain = 0.0f;
    std::optional<ColorMapView> color_map = {};
    std::optional<CutView> cut = {};
    std::optional<ArrowView> arrows = {};          ///< velocities
    std::optional<ArrowView> contact_forces = {};  ///< each begins at a node that is pressed
    std::optional<ObjectView> objects = {};
    bool wireframe = false;
    /// Two vec4: xyz of one end [m], 0 for a point of an attachment, 1 for a line between its sides, 2 for an
    /// axis, 3 for a bone, 4 for a node that it carries; xyz of the other end [m], 0; shape [line_count]
    unsigned lines = 0;
    std::uint32_t line_count = 0;
};

/// Triangles with the same texture, in place of their object's colour.
struct TexturedTriangles {
    std::uint32_t first = 0, count = 0;  ///< of RenderView::triangles
    unsigned texture = 0;                ///< of linear RGB, GL_TEXTURE_2D
};

/// What a renderer needs to draw the deformable bodies directly from the simulation's buffers: names of GL
/// buffer objects (std430) in the simulator's context, and counts. Valid until the simulator's next frame;
/// with the CPU backend, whose state is in host memory, until the next view.
///
/// What is drawn is the bodies' own surfaces, their skins, where they have such. Then the positions are those
/// of the skins' points, not of nodes. Where overlays show values or marks of the boundary of the tets, it is
/// drawn.
struct RenderView {
    unsigned node_positions = 0;    ///< vec4: xyz [m] of nodes, or of points of skins; shape [node_count]
    unsigned surface_vertices = 0;  ///< SurfaceVertex (node or point, object, ...); shape [vertices]
    unsigned vertex_normals = 0;    ///< vec4: unit normal xyz, 0; shape [vertices]
    unsigned triangles = 0;         ///< three uint indices into surface_vertices; shape [faces]
    unsigned vertex_uvs = 0;        ///< two floats, texture coordinates; shape [vertices]; 0: no textures
    std::uint32_t node_count = 0;
    std::uint32_t vertex_count = 0;
    std::uint32_t face_count = 0;
    std::uint32_t object_count = 0;
    float box_min[3] = {};  ///< bounding box of all nodes or points [m]
    float box_max[3] = {};
    std::span<const TexturedTriangles> textured = {};  ///< the last triangles, in ascending order
    bool box_is_late = false;  ///< the box is that of an earlier view, because reading a GPU's would wait
    OverlayView overlay{};
};

}  // namespace gelatin
