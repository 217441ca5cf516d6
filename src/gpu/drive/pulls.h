#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "gelatin/pull.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace gelatin::gpu {

/// Nodes that a hand holds, for programs that include sim/drive/pull.glsl, with PULLED. CPU twin: cpu::Pulls.
class Pulls {
public:
    explicit Pulls(std::size_t node_count);

    /// Empty: nobody holds anything any more.
    void set(const std::optional<Pull>& pull);
    void move(const glm::dvec3& target) { target_ = glm::vec3(target); }

    void bind(const gl::Program& program) const;

private:
    std::vector<std::uint32_t> held_;
    std::vector<glm::vec4> by_node_;  // as in the buffer: place from the target [m], stiffness [N/m]
    gl::Buffer<glm::vec4> buffer_;
    gl::BufferTexture texels_;
    glm::vec3 target_{0.0f};
    float damping_time_ = 0.0f;
};

}  // namespace gelatin::gpu
