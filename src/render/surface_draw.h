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

    /// True if some triangles have textures, and objects do not have to be distinguished by their colours.
    bool has_textures() const { return !view_.textured.empty() && !view_.overlay.objects; }

    /// For programs that include render/include/surface_fetch.glsl.
    void bind(const gl::Program& program) const;
    /// For "triangles" of the program: one texel of three vertices each.
    void bind_triangles(const gl::Program& program) const { program.bind("triangles", triangles_); }

    /// Draws all faces with a program that fetches vertices. @pre a vertex array object is bound; the same
    /// for those that follow
    void draw(const gl::Program& program) const;
    /// The faces that have the colours of their objects; all if has_textures is false. @pre what the program
    /// needs is bound
    void draw_plain(const gl::Program& program) const;
    /// The others, whose texture becomes "albedo_texture" of the program, and the coordinates "vertex_uvs".
    /// @pre as draw_plain, and has_textures
    void draw_textured(const gl::Program& program) const;

private:
    RenderView view_;
    gl::BufferTexture node_positions_;
    gl::BufferTexture surface_vertices_;
    gl::BufferTexture vertex_normals_;
    gl::BufferTexture triangles_;
    gl::BufferTexture vertex_uvs_;
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
