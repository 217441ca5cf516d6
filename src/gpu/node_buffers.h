#pragma once

#include <glm/vec4.hpp>
#include <span>

#include "gl/buffer.h"

namespace gelatin::gpu {

/// Positions and velocities of all nodes on the GPU, written as storage and gathered as textures.
struct NodeBuffers {
    gl::Buffer<glm::vec4> positions;   ///< xyz [m], inverse mass [1/kg], shape [nodes]
    gl::Buffer<glm::vec4> velocities;  ///< xyz [m/s], damping time [s], shape [nodes]
    gl::BufferTexture position_texels, velocity_texels;

    NodeBuffers() = default;
    NodeBuffers(std::span<const glm::vec4> initial_positions, std::span<const glm::vec4> initial_velocities)
        : positions(initial_positions),
          velocities(initial_velocities),
          position_texels(positions, gl::TexelFormat::rgba32f),
          velocity_texels(velocities, gl::TexelFormat::rgba32f) {}
};

}  // namespace gelatin::gpu
