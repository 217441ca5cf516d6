#pragma once

#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/self_collision_buffers.h"
#include "gpu/model_buffers.h"

namespace gelatin::gpu {

/// Marks the faces that touch another object, or their own, for drawing: shaders/sim/view/mark_faces.comp.
class MarkFaces {
public:
    explicit MarkFaces(const Model& model);
    /// Ends with the barrier that drawing needs. @param self null where nothing collides with itself
    /// @param marks shape [faces]
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const SelfCollisionBuffers* self,
             const gl::Buffer<std::uint32_t>& marks) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::gpu
