#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Draws surfaces lit at each vertex by a compute shader (the paper's light, 3.1), which also computes clip
/// coordinates. Drawing only fetches the results: on software drivers compute shaders run on all threads,
/// vertex shaders on one. Textures are looked up at each pixel, and lit by the light at the vertices.
class VertexLight {
public:
    VertexLight();

    /// Lights the vertices of a layer. @pre the shadows' textures are bound
    void light(const Frame& frame, const Layer& layer);

    /// Draws the layer that was lit last. @pre a vertex array object is bound
    void draw(const Layer& layer) const;

    /// By surface vertex: clip coordinates; RGBA8, sRGB values.
    const gl::Buffer<glm::vec4>& clip_positions() const { return clip_positions_; }
    const gl::Buffer<std::uint32_t>& display_colors() const { return display_colors_; }

private:
    struct Programs {
        gl::Program light, draw;
        explicit Programs(const gl::Defines& defines);
    };
    Programs plain_;
    std::optional<Programs> textured_;  // made when textures are first drawn
    gl::Buffer<glm::vec4> texture_lights_;
    gl::Buffer<glm::vec4> clip_positions_;
    gl::Buffer<std::uint32_t> display_colors_;
};

}  // namespace gelatin::render
