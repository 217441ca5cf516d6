#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <initializer_list>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/surface_draw.h"
#include "render/target.h"

namespace gelatin::render {

/// Makes small depth maps with a compute shader instead of the rasteriser: several times cheaper on software
/// drivers for surfaces of many small faces (shaders/render/splat_depth.comp).
class DepthSplats {
public:
    DepthSplats();

    /// Fills `map`, a depth texture, with the faces that look at the light, and what lies before or behind it
    /// clamped.
    /// @param world_to_clip without perspective
    void draw(const Target& map, const glm::mat4& world_to_clip,
              std::initializer_list<const SurfaceDraw*> surfaces);

private:
    gl::Program program_;
    gl::Buffer<std::uint32_t>
        depths_;  // 2^32 - 1 is the far plane, shape [rows][columns] of the map, and unused ones
};

}  // namespace gelatin::render
