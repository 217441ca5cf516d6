#pragma once

#include "gelatin/scene.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// The paper's response (2.4): shaders/sim/collision/count_shares.comp, sum_contacts.comp,
/// plan_responses.comp, respond.comp.
class Respond {
public:
    Respond(const Model& model, const CollisionBuffers& collision, const CollisionSettings& settings);

    /// Writes `current`. Ends with the barriers that the next step, and whoever gathers the nodes as
    /// textures, needs. @param resting_speed slower than this [m/s], nothing bounces
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& previous,
             const NodeBuffers& current, double step) const;

private:
    gl::Program share_program_, patch_program_, approach_program_, plan_program_, respond_program_;
    gl::Buffer<std::uint32_t> node_shares_;  // shape [nodes]
    gl::BufferTexture node_share_texels_;
    gl::Buffer<ContactPatch> patches_;
    gl::Buffer<ApproachSums> approaches_;
    gl::Buffer<ContactResponse> responses_;
};

}  // namespace gelatin::gpu
