#include "render/depth_splats.h"

#include <epoxy/gl.h>

#include <glm/ext/matrix_transform.hpp>

namespace gelatin::render {

DepthSplats::DepthSplats() : program_(gl::Program::compute("render/splat_depth.comp")) {}

void DepthSplats::draw(const Target& map, const glm::mat4& world_to_clip,
                       std::initializer_list<const SurfaceDraw*> surfaces) {
    const glm::ivec2 size(map.width(), map.height());
    const auto texels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    if (depths_.size() < texels) depths_ = gl::Buffer<std::uint32_t>(texels);
    depths_.fill(0xffffffffu);

    glm::mat4 clip_to_map = glm::scale(glm::mat4(1.0f), 0.5f * glm::vec3(size, 1.0f));
    clip_to_map = glm::translate(clip_to_map, glm::vec3(1.0f));
    program_.set("world_to_map", clip_to_map * world_to_clip);
    program_.set("map_size", size);
    depths_.bind_storage(0);
    for (const SurfaceDraw* surface : surfaces) {
        surface->bind_textures();
        surface->bind_triangles(3);
        program_.set("face_count", surface->face_count());
        program_.dispatch(surface->face_count());
    }
    // Into the texture now, and filled anew for the next map.
    gl::barrier(gl::Barrier::pixel_unpack | gl::Barrier::buffer_update);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, depths_.id());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, map.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace gelatin::render
