#pragma once

#include "gelatin/views.h"
#include "gl/buffer.h"

namespace gelatin::render {

/// The buffers of a RenderView made ready for shaders/include/surface_fetch.glsl; as long-lived as the view.
class SurfaceDraw {
public:
    explicit SurfaceDraw(const RenderView& view);

    std::uint32_t vertex_count() const { return view_.vertex_count; }
    std::uint32_t face_count() const { return view_.face_count; }

    /// For shaders that fetch points: units 0 to 2.
    void bind_textures() const;
    /// The triangles as a usamplerBuffer, a texel of three vertices each.
    void bind_triangles(unsigned unit) const { triangles_.bind(unit); }

    /// Draws all faces with the program in use, which fetches points. @pre a vertex array object is bound
    void draw() const;
    /// The same with a program that takes what it needs from the vertex array object that is bound.
    void draw_triangles() const;

private:
    RenderView view_;
    gl::BufferTexture node_positions_;
    gl::BufferTexture surface_vertices_;
    gl::BufferTexture vertex_normals_;
    gl::BufferTexture triangles_;
};

}  // namespace gelatin::render
