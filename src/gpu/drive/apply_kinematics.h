#pragma once

#include <span>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Moves the nodes that handles hold: shaders/sim/drive/apply_kinematics.comp. CPU twin:
/// cpu::apply_kinematics.
class ApplyKinematics {
public:
    /// @pre the model has pins or handles
    explicit ApplyKinematics(const Model& model);

    /// Ends with the barrier for gathering the nodes as textures or storage.
    void run(std::span<const HandleMotion> motions, std::span<const NodeMotion> animated,
             const NodeBuffers& nodes);

private:
    gl::Program program_;
    gl::Buffer<HandleNode> handle_nodes_;
    gl::Buffer<HandleMotion> motions_;
    gl::Buffer<NodeMotion> animated_;
};

}  // namespace gelatin::gpu
