#pragma once

#include <optional>

#include "gl/readback.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/tree_buffers.h"

namespace gelatin::gpu {

/// A tree over the bounding boxes of all objects: shaders/sim/collision/update_boxes.comp with OBJECTS. Its
/// topology does not change. The order of the objects in it is renewed from time to time on the host, from
/// boxes that are read back without waiting. The order affects how fast objects are found, not which. CPU
/// twin: cpu::ObjectTree.
class ObjectTree {
public:
    explicit ObjectTree(const Model& model);

    /// Ends with the barriers that a walk through the tree needs.
    void update(const CollisionBuffers& collision);

    /// For programs that include sim/collision/object_may_touch.glsl, with OBJECT_TREE.
    void bind(const gl::Program& program) const;

private:
    void renew_order();
    void fetch_boxes(const CollisionBuffers& collision);

    TreeBuffers tree_;
    gl::Program leaf_program_, node_program_;
    gl::Buffer<std::uint32_t> order_;  // of the objects in the tree
    gl::BufferTexture order_texels_;
    gl::Readback readback_;  // of bounding boxes
    int age_ = 0;            // age of the order, in updates
};

}  // namespace gelatin::gpu
