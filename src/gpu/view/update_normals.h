#pragma once

#include <span>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/draw_surface.h"

namespace gelatin::gpu {

/// A surface to draw, on the GPU, and the stage that updates its normals (paper 3.1):
/// shaders/sim/view/update_face_normals.comp and update_vertex_normals.comp.
class UpdateNormals {
public:
    /// @param faces between nodes, or between points of a skin @param surface over these faces
    UpdateNormals(std::span<const Face> faces, const DrawSurface& surface);

    /// Ends with the barriers that drawing needs. @param position_texels of the nodes or points
    void run(const gl::BufferTexture& position_texels) const;

    /// What a renderer draws, with the nodes or points of `positions`.
    RenderView view(const gl::Buffer<glm::vec4>& positions) const;

    const gl::Buffer<glm::vec4>& face_normals() const { return face_normals_; }
    const gl::Buffer<glm::vec4>& vertex_normals() const { return vertex_normals_; }

private:
    gl::Program face_program_, vertex_program_;
    gl::Buffer<Face> faces_;
    gl::Buffer<SurfaceVertex> vertices_;
    gl::Buffer<std::uint32_t> vertex_faces_;
    gl::Buffer<glm::uvec3> triangles_;
    gl::Buffer<glm::vec4> face_normals_;    // length: twice the area [m^2]
    gl::Buffer<glm::vec4> vertex_normals_;  // unit
    gl::BufferTexture vertex_face_texels_, face_normal_texels_;
    std::uint32_t object_count_;  // of faces
};

}  // namespace gelatin::gpu
