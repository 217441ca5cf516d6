#pragma once

#include "gpu/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// The box of each face and of each object: shaders/sim/update_boxes.comp, merge_boxes.comp.
class UpdateBoxes {
public:
    UpdateBoxes();
    /// Ends with the barrier that the next stage needs.
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& nodes) const;

private:
    gl::Program update_program_, merge_program_;
};

}  // namespace gelatin::gpu
