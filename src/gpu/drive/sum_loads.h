#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Adds up the forces of loads on the nodes: shaders/sim/drive/sum_loads.comp. CPU twin: cpu::sum_loads.
class SumLoads {
public:
    /// Every load acts until set_factors is called. @pre the model has loads
    explicit SumLoads(const Model& model);

    /// @param factors of each load
    void set_factors(std::span<const float> factors);

    /// Pressures act on faces as they lie in `nodes`. Ends with the barrier that the next pass needs.
    void run(const NodeBuffers& nodes) const;

    /// For programs that include sim/drive/load_force.glsl.
    static gl::Defines defines(const Model& model) {
        return model.loads.empty() ? gl::Defines{} : gl::Defines{"LOADED"};
    }
    void bind(const gl::Program& program) const { program.bind("load_forces", force_texels_); }

    const gl::Buffer<glm::vec4>& forces() const { return forces_; }  ///< [N], shape [nodes]

private:
    gl::Program program_;
    gl::Buffer<LoadedNode> loaded_nodes_;
    gl::Buffer<NodeLoad> node_loads_;
    std::vector<float> factors_;  // as they are in the buffer
    gl::Buffer<float> factor_buffer_;
    gl::Buffer<glm::vec4> forces_;
    gl::BufferTexture force_texels_;
};

}  // namespace gelatin::gpu
