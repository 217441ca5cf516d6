#pragma once

#include <glm/vec4.hpp>

#include "gelatin/views.h"
#include "gl/buffer.h"

namespace gelatin::render {

/// The buffers of a RenderView made ready for shaders/render/include/surface_fetch.glsl; as long-lived as the
/// view.
class SurfaceDraw {
public:
    explicit SurfaceDraw(const RenderView& view);

    std::uint32_t vertex_count() const { return view_.vertex_count; }
    std::uint32_t face_count() const { return view_.face_count; }

    /// Where an overlay cuts the surfaces open: what is on the plane's positive side is not drawn.
    bool is_cut() const { return view_.overlay.cut.has_value(); }
    /// All 0 where nothing is cut.
    glm::vec4 cut_plane() const;

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

/// While it lives, programs that tell their distance from the plane do not draw beyond it, where there is
/// one.
class Clipping {
public:
    explicit Clipping(const SurfaceDraw& surfaces);
    Clipping(const Clipping&) = delete;
    Clipping& operator=(const Clipping&) = delete;
    ~Clipping();
};

}  // namespace gelatin::render
