#pragma once

#include <glm/vec4.hpp>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"

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

    /// For programs that include render/include/surface_fetch.glsl.
    void bind(const gl::Program& program) const;
    /// "triangles" of the program: a texel of three vertices each.
    void bind_triangles(const gl::Program& program) const { program.bind("triangles", triangles_); }

    /// Draws all faces with a program that fetches points. @pre a vertex array object is bound
    void draw(const gl::Program& program) const;
    /// The same with a program that has vertex inputs.
    void draw_triangles(const gl::Program& program) const;

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
