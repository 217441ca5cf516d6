#pragma once

#include "gpu/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Runs shaders/sim/update_boxes.comp over a level of trees whose buffers are bound.
void update_level(const gl::Program& program, const TreeBuffers& trees, std::size_t level);

/// The box of each face and of each object: shaders/sim/update_boxes.comp, a dispatch for each
/// level of the trees.
class UpdateBoxes {
public:
    UpdateBoxes();
    /// Ends with the barrier that the next stage needs.
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& nodes) const;

private:
    gl::Program leaf_program_, node_program_;
};

}  // namespace gelatin::gpu
