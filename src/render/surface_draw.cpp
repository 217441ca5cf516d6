#include "render/surface_draw.h"

#include <epoxy/gl.h>

namespace gelatin::render {

SurfaceDraw::SurfaceDraw(const RenderView& view)
    : view_(view),
      node_positions_(view.node_positions, std::size_t{16} * view.node_count, gl::TexelFormat::rgba32f),
      surface_vertices_(view.surface_vertices, std::size_t{16} * view.vertex_count,
                        gl::TexelFormat::rgba32ui),
      vertex_normals_(view.vertex_normals, std::size_t{16} * view.vertex_count, gl::TexelFormat::rgba32f),
      triangles_(view.triangles, std::size_t{12} * view.face_count, gl::TexelFormat::rgb32ui) {
    if (has_textures())
        vertex_uvs_ = {view.vertex_uvs, std::size_t{8} * view.vertex_count, gl::TexelFormat::rg32f};
}

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
    program.draw_elements(gl::Primitive::triangles, view_.triangles, std::size_t{3} * view_.face_count);
}

void SurfaceDraw::draw_plain(const gl::Program& program) const {
    const std::uint32_t count = has_textures() ? view_.textured.front().first : view_.face_count;
    program.draw_elements(gl::Primitive::triangles, view_.triangles, std::size_t{3} * count);
}

void SurfaceDraw::draw_textured(const gl::Program& program) const {
    program.bind("vertex_uvs", vertex_uvs_);
    for (const TexturedTriangles& part : view_.textured) {
        program.bind_texture("albedo_texture", part.texture);
        program.draw_elements(gl::Primitive::triangles, view_.triangles, std::size_t{3} * part.count,
                              std::size_t{3} * part.first);
    }
}

Clipping::Clipping(const SurfaceDraw& surfaces) {
    if (surfaces.is_cut()) glEnable(GL_CLIP_DISTANCE0);
}

Clipping::~Clipping() {
    glDisable(GL_CLIP_DISTANCE0);
}

}  // namespace gelatin::render
