#include "render/turned_view.h"

#include "render/up_axis.h"

namespace gelatin::render {
namespace {

void turn_point(float (&point)[3]) {
    const glm::vec3 turned = to_y_up(glm::vec3(point[0], point[1], point[2]), Axis::z);
    for (int k = 0; k < 3; ++k) point[k] = turned[k];
}

}  // namespace

TurnedView::TurnedView() : program_(gl::Program::compute("render/turn_vectors.comp")) {}

unsigned TurnedView::copy(unsigned from, std::size_t count, gl::Buffer<glm::vec4>& to) {
    if (from == 0 || count == 0) return from;
    if (to.size() < count) to = gl::Buffer<glm::vec4>(count);
    const gl::BufferTexture source(from, count * sizeof(glm::vec4), gl::TexelFormat::rgba32f);
    program_.bind("vectors", source);
    program_.bind("Turned", to);
    program_.set("vector_count", static_cast<std::uint32_t>(count));
    program_.dispatch(count);
    return to.id();
}

// The two corners of a box become two other opposite corners of it, which is enough to draw it.
RenderView TurnedView::turn(const RenderView& view) {
    RenderView turned = view;
    OverlayView& overlay = turned.overlay;
    turned.node_positions = copy(view.node_positions, view.node_count, positions_);
    turned.vertex_normals = copy(view.vertex_normals, view.vertex_count, normals_);
    overlay.node_positions = copy(overlay.node_positions, overlay.node_count, nodes_);
    overlay.boxes = copy(overlay.boxes, std::size_t{2} * overlay.box_count, boxes_);
    overlay.lines = copy(overlay.lines, std::size_t{2} * overlay.line_count, lines_);
    if (overlay.arrows)
        overlay.arrows->vectors = copy(overlay.arrows->vectors, overlay.node_count, velocities_);
    if (overlay.contact_forces)
        overlay.contact_forces->vectors = copy(overlay.contact_forces->vectors, overlay.node_count, forces_);
    gl::barrier(gl::Barrier::texture_fetch);
    if (overlay.cut) {
        const glm::vec3 normal(overlay.cut->plane[0], overlay.cut->plane[1], overlay.cut->plane[2]);
        const glm::vec3 turned_normal = to_y_up(normal, Axis::z);
        for (int k = 0; k < 3; ++k) overlay.cut->plane[k] = turned_normal[k];
    }
    turn_point(turned.box_min);
    turn_point(turned.box_max);
    std::swap(turned.box_min[2], turned.box_max[2]);
    return turned;
}

}  // namespace gelatin::render
