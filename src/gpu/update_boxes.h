#pragma once

#include "gelatin/scene.h"
#include "gpu/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Runs shaders/sim/update_boxes.comp over a level of trees whose buffers are bound.
void update_level(const gl::Program& program, const TreeBuffers& trees, std::size_t level);

/// The box of each face and of each object, over the whole step with continuous detection:
/// shaders/sim/update_boxes.comp, a dispatch for each level of the trees.
class UpdateBoxes {
public:
    explicit UpdateBoxes(CollisionDetection detection);
    /// Ends with the barrier that the next stage needs.
    /// @param previous the nodes at the start of the step, which discrete detection does not read
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& previous,
             const NodeBuffers& nodes) const;

private:
    gl::Program leaf_program_, node_program_;
};

}  // namespace gelatin::gpu
