#include "render/depth_splats.h"

#include <epoxy/gl.h>

#include <bit>
#include <cassert>
#include <glm/ext/matrix_transform.hpp>
#include <string>

#include "gl/hazards.h"

namespace gelatin::render {
namespace {

std::size_t texel_count(const DepthMap& map) {
    return static_cast<std::size_t>(map.target.width()) * static_cast<std::size_t>(map.target.height());
}

glm::mat4 world_to_texels(const DepthMap& map) {
    const glm::vec3 size(map.target.width(), map.target.height(), 1.0f);
    const glm::mat4 clip_to_map = glm::scale(glm::mat4(1.0f), 0.5f * size);
    return glm::translate(clip_to_map, glm::vec3(1.0f)) * map.world_to_clip;
}

}  // namespace

DepthSplats::DepthSplats() : program_(gl::Program::compute("render/splat_depth.comp")) {}

void DepthSplats::set_maps(const gl::Program& program, std::span<const DepthMap> maps) {
    std::size_t start = 0;
    for (std::size_t m = 0; m < maps.size(); ++m) {
        const std::string place = "[" + std::to_string(m) + "]";
        const Target& target = maps[m].target;
        program.set("world_to_map" + place, world_to_texels(maps[m]));
        program.set("map_size" + place, glm::ivec2(target.width(), target.height()));
        program.set("map_start" + place, static_cast<int>(start));
        start += texel_count(maps[m]);
    }
    program.set("map_count", static_cast<int>(maps.size()));
}

const gl::Program& DepthSplats::program_for(const SurfaceDraw& surface) {
    if (!surface.is_cut()) return program_;
    if (!cut_program_) cut_program_ = gl::Program::compute("render/splat_depth.comp", {"CUT"});
    cut_program_->set("cut_plane", surface.cut_plane());
    return *cut_program_;
}

void DepthSplats::draw(std::span<const DepthMap> maps, std::initializer_list<const SurfaceDraw*> surfaces) {
    assert(maps.size() <= kMostMaps);
    std::size_t texels = 0;
    for (const DepthMap& map : maps) texels += texel_count(map);
    if (depths_.size() < texels) depths_ = gl::Buffer<std::uint32_t>(texels);
    depths_.fill(0xffffffffu);
    for (const SurfaceDraw* surface : surfaces) {
        const gl::Program& program = program_for(*surface);
        set_maps(program, maps);
        program.bind("DepthMaps", depths_);
        surface->bind(program);
        surface->bind_triangles(program);
        program.set("face_count", surface->face_count());
        program.dispatch(surface->face_count());
        gl::barrier(gl::Barrier::storage);  // the next one adds to the same maps
    }
    // Copied into the textures now, and cleared for the next frame.
    gl::barrier(gl::Barrier::pixel_unpack | gl::Barrier::buffer_update);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, depths_.id());
    gl::forget_state();  // a unit's binding changes
    if (gl::hazard_probe != nullptr) gl::hazard_probe->uploads_to_texture(depths_.id());
    std::size_t start = 0;
    for (const DepthMap& map : maps) {
        glBindTexture(GL_TEXTURE_2D, map.target.texture());
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, map.target.width(), map.target.height(), GL_DEPTH_COMPONENT,
                        GL_UNSIGNED_INT, std::bit_cast<const void*>(start * sizeof(std::uint32_t)));
        start += texel_count(map);
    }
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace gelatin::render
