#pragma once

#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "gelatin/pull.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace gelatin::gpu {

/// Nodes that a hand holds, for programs that include sim/drive/pull.glsl. CPU twin: cpu::Pulls.
class Pulls {
public:
    explicit Pulls(std::size_t node_count);

    /// What a hand holds from now on; empty: nothing.
    void set(const std::optional<Pull>& pull);
    void move(const glm::dvec3& target) { target_ = glm::vec3(target); }

    void bind(const gl::Program& program) const;

private:
    void allocate(std::size_t size);

    std::size_t node_count_;
    std::vector<std::uint32_t> held_;
    // As in the buffer: place from the target [m], stiffness [N/m]; of one node until a hand holds something.
    std::vector<glm::vec4> by_node_;
    gl::Buffer<glm::vec4> buffer_;
    gl::BufferTexture texels_;
    glm::vec3 target_{0.0f};
    float damping_time_ = 0.0f;
};

}  // namespace gelatin::gpu
