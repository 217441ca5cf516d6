#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/drive/acted_nodes.h"

namespace gelatin::gpu {

/// Pulls and forces that act on nodes from outside, for programs that include sim/drive/pull.glsl. CPU twin:
/// cpu::Pulls.
class Pulls {
public:
    explicit Pulls(std::size_t node_count);

    void set_pulls(std::vector<Pull> pulls);
    void move_pull(std::size_t pull, const glm::dvec3& target);
    void set_forces(std::span<const glm::vec3> forces);

    /// Whether anything acts.
    bool is_acting() const { return !acted_.nodes().empty(); }
    void bind(const gl::Program& program) const;

private:
    void allocate(std::size_t node_count);
    void upload();

    ActedNodes acted_;
    std::size_t uploaded_ = 0;  // nodes from the first to the last on which something acts in the buffer
    gl::Buffer<NodeActions> buffer_;  // of one node until something acts
    gl::BufferTexture texels_;
};

}  // namespace gelatin::gpu
