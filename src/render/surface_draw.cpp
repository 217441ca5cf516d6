#include "render/surface_draw.h"

#include <epoxy/gl.h>

namespace gelatin::render {

SurfaceDraw::SurfaceDraw(const RenderView& view)
    : view_(view),
      node_positions_(view.node_positions, std::size_t{16} * view.node_count, gl::TexelFormat::rgba32f),
      surface_vertices_(view.surface_vertices, std::size_t{16} * view.vertex_count,
                        gl::TexelFormat::rgba32ui),
      vertex_normals_(view.vertex_normals, std::size_t{16} * view.vertex_count, gl::TexelFormat::rgba32f),
      triangles_(view.triangles, std::size_t{12} * view.face_count, gl::TexelFormat::rgb32ui) {}

glm::vec4 SurfaceDraw::cut_plane() const {
    if (!is_cut()) return glm::vec4(0.0f);
    const float* plane = view_.overlay.cut->plane;
    return {plane[0], plane[1], plane[2], plane[3]};
}

void SurfaceDraw::bind(const gl::Program& program) const {
    program.bind("node_positions", node_positions_);
    program.bind("surface_vertices", surface_vertices_);
    program.bind("vertex_normals", vertex_normals_);
}

void SurfaceDraw::draw(const gl::Program& program) const {
    bind(program);
    draw_triangles(program);
}

void SurfaceDraw::draw_triangles(const gl::Program& program) const {
    program.draw_elements(gl::Primitive::triangles, view_.triangles, std::size_t{3} * view_.face_count);
}

Clipping::Clipping(const SurfaceDraw& surfaces) {
    if (surfaces.is_cut()) glEnable(GL_CLIP_DISTANCE0);
}

Clipping::~Clipping() {
    glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace gelatin::render
