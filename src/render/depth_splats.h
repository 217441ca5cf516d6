#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <initializer_list>
#include <optional>
#include <span>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/surface_draw.h"
#include "render/target.h"

namespace gelatin::render {

/// A depth texture, and its view of the world.
struct DepthMap {
    const Target& target;
    glm::mat4 world_to_clip;  ///< without perspective
};

/// Draws small depth maps with a compute shader instead of the rasteriser: several times cheaper on software
/// drivers for surfaces of many small faces (shaders/render/splat_depth.comp).
class DepthSplats {
public:
    static constexpr std::size_t kMostMaps = 2;  ///< as in the shader

    DepthSplats();

    /// Draws the faces that face the light into the maps. Depths in front of or behind a map are clamped.
    /// @pre maps.size() <= kMostMaps
    void draw(std::span<const DepthMap> maps, std::initializer_list<const SurfaceDraw*> surfaces);

private:
    static void set_maps(const gl::Program& program, std::span<const DepthMap> maps);
    const gl::Program& program_for(const SurfaceDraw& surface);

    gl::Program program_;
    std::optional<gl::Program> cut_program_;  // only after something was cut open
    gl::Buffer<std::uint32_t>
        depths_;  // 2^32 - 1 is the far plane, shape [map][row][column], and unused maps
};

}  // namespace gelatin::render
