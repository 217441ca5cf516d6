#pragma once

#include "gelatin/scene.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Binds the trees to a program of shaders/sim/collision/update_boxes.comp.
void bind_levels(const gl::Program& program, const TreeBuffers& trees,
                 const gl::Buffer<BoundingBox>& bounding_boxes);

/// Runs that program over a level of the trees.
void update_level(const gl::Program& program, const TreeBuffers& trees, std::size_t level);

/// Sets what shaders/sim/collision/box_margin.glsl reads. CPU twin: cpu::BoxMargin.
void set_margin(const gl::Program& program, double reach);

/// The box of each face and of each object, over the whole step with continuous detection:
/// shaders/sim/collision/update_boxes.comp, a dispatch for each level of the trees.
class UpdateBoxes {
public:
    /// @param reach objects and faces nearer than this have boxes that meet [m]
    explicit UpdateBoxes(CollisionDetection detection, double reach = 0.0);
    /// Ends with the barrier that the next stage needs.
    /// @param previous the nodes at the start of the step, which discrete detection does not read
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& previous,
             const NodeBuffers& nodes) const;

private:
    gl::Program leaf_program_, node_program_;
};

}  // namespace gelatin::gpu
