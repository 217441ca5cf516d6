#pragma once

#include "gelatin/scene.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/face_filter.h"
#include "gpu/node_buffers.h"

namespace gelatin::gpu {

/// Face against face in the pairs of objects: shaders/sim/collision/list_candidates.comp, scan_tests.comp,
/// walk_trees.comp or cull_face_pairs.comp, test_face_pairs.comp. All dispatches are indirect: nothing runs
/// if no faces are near.
class FindFaceCollisions {
public:
    /// @param filter that FindObjectPairs has, or null. Has to outlive this.
    explicit FindFaceCollisions(const CollisionSettings& settings, const FaceFilter* filter = nullptr);
    /// Ends with the barrier that the next stage needs.
    /// @param previous the nodes at the start of the step, which discrete detection does not read
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& previous,
             const NodeBuffers& nodes) const;

private:
    bool walks_;  // through trees
    const FaceFilter* filter_;
    gl::Program list_program_, scan_program_, cull_program_, test_program_;
};

}  // namespace gelatin::gpu
