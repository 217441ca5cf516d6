#include "gpu/view/update_normals.h"

namespace gelatin::gpu {

UpdateNormals::UpdateNormals(std::span<const Face> faces, const DrawSurface& surface)
    : face_program_(gl::Program::compute("sim/view/update_face_normals.comp")),
      vertex_program_(gl::Program::compute("sim/view/update_vertex_normals.comp")),
      faces_(faces),
      vertices_(std::span(surface.vertices)),
      vertex_faces_(std::span(surface.vertex_faces)),
      triangles_(std::span(surface.triangles)),
      face_normals_(faces.size()),
      vertex_normals_(surface.vertices.size()),
      vertex_face_texels_(vertex_faces_, gl::TexelFormat::r32ui),
      face_normal_texels_(face_normals_, gl::TexelFormat::rgba32f),
      object_count_(faces.empty() ? 0 : faces.back().object + 1) {
    face_program_.bind("Faces", faces_);
    face_program_.bind("FaceNormals", face_normals_);
    vertex_program_.bind("face_normals", face_normal_texels_);
    vertex_program_.bind("vertex_faces", vertex_face_texels_);
    vertex_program_.bind("SurfaceVertices", vertices_);
    vertex_program_.bind("VertexNormals", vertex_normals_);
}

void UpdateNormals::run(const gl::BufferTexture& position_texels) const {
    face_program_.bind("positions", position_texels);
    face_program_.set("face_count", static_cast<std::uint32_t>(faces_.size()));
    face_program_.dispatch(faces_.size());
    // storage: pictures of the state before may still read what is written next
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);

    vertex_program_.set("vertex_count", static_cast<std::uint32_t>(vertices_.size()));
    vertex_program_.dispatch(vertices_.size());
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::vertex_pull | gl::Barrier::storage);
}

RenderView UpdateNormals::view(const gl::Buffer<glm::vec4>& positions) const {
    RenderView view;
    view.node_positions = positions.id();
    view.surface_vertices = vertices_.id();
    view.vertex_normals = vertex_normals_.id();
    view.triangles = triangles_.id();
    view.node_count = static_cast<std::uint32_t>(positions.size());
    view.vertex_count = static_cast<std::uint32_t>(vertices_.size());
    view.face_count = static_cast<std::uint32_t>(faces_.size());
    view.object_count = object_count_;
    return view;
}

}  // namespace gelatin::gpu
