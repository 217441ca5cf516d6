#pragma once

#include "gpu/collision_buffers.h"
#include "gpu/model_buffers.h"

namespace gelatin::gpu {

/// Marks the faces that touch another object, for drawing: shaders/sim/mark_faces.comp.
class MarkFaces {
public:
    MarkFaces();
    /// Ends with the barrier that drawing needs. @param marks shape [faces]
    void run(const ModelBuffers& model, const CollisionBuffers& collision,
             const gl::Buffer<std::uint32_t>& marks) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::gpu
