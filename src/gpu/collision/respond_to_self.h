#pragma once

#include "gelatin/scene.h"
#include "gl/program.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/self_collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// The response to faces that touch others of their own object: shaders/sim/collision/respond_to_self.comp.
/// CPU twin: cpu::RespondToSelf.
class RespondToSelf {
public:
    RespondToSelf(const Model& model, const CollisionSettings& settings);

    /// Writes `current`. Respond, which follows, has the barriers that readers of the nodes need. @param step
    /// from `previous` to `current` [s]
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const SelfCollisionBuffers& self,
             const NodeBuffers& previous, const NodeBuffers& current, double step) const;

private:
    gl::Program face_program_, node_program_;
    gl::Buffer<glm::vec4> answers_;  // change of velocity [m/s] and displacement [m], shape [faces][2]
};

}  // namespace gelatin::gpu
