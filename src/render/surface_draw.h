#pragma once

#include <glm/vec4.hpp>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace gelatin::render {

/// The buffers of a RenderView, prepared for shaders/render/include/surface_fetch.glsl; valid as long as the
/// view.
class SurfaceDraw {
public:
    explicit SurfaceDraw(const RenderView& view);

    std::uint32_t vertex_count() const { return view_.vertex_count; }
    std::uint32_t face_count() const { return view_.face_count; }

    /// Where an overlay cuts the surfaces open: the plane's positive side is not drawn.
    bool is_cut() const { return view_.overlay.cut.has_value(); }
    /// All 0 without a cut.
    glm::vec4 cut_plane() const;

    /// For programs that include render/include/surface_fetch.glsl.
    void bind(const gl::Program& program) const;
    /// For "triangles" of the program: one texel of three vertices each.
    void bind_triangles(const gl::Program& program) const { program.bind("triangles", triangles_); }

    /// Draws all faces with a program that fetches vertices. @pre a vertex array object is bound
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

/// During its lifetime, programs that write their distance from the plane draw only one side of it, if there
/// is a cut.
class Clipping {
public:
    explicit Clipping(const SurfaceDraw& surfaces);
    Clipping(const Clipping&) = delete;
    Clipping& operator=(const Clipping&) = delete;
    ~Clipping();
};

}  // namespace gelatin::render
