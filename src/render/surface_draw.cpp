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

void SurfaceDraw::bind_textures() const {
    node_positions_.bind(0);
    surface_vertices_.bind(1);
    vertex_normals_.bind(2);
}

void SurfaceDraw::draw() const {
    if (view_.face_count == 0) return;
    bind_textures();
    draw_triangles();
}

void SurfaceDraw::draw_triangles() const {
    if (view_.face_count == 0) return;
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, view_.triangles);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * view_.face_count), GL_UNSIGNED_INT, nullptr);
}

Clipping::Clipping(const SurfaceDraw& surfaces) {
    if (surfaces.is_cut()) glEnable(GL_CLIP_DISTANCE0);
}

Clipping::~Clipping() {
    glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace gelatin::render
