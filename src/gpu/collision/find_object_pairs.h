#pragma once

#include <optional>

#include "gelatin/scene.h"
#include "gpu/collision/collision_buffers.h"
#include "gpu/collision/face_filter.h"
#include "gpu/collision/object_tree.h"

namespace gelatin::gpu {

/// The pairs of objects that may touch, one row for each object:
/// shaders/sim/collision/count_object_pairs.comp, scan_pair_rows.comp, list_object_pairs.comp.
class FindObjectPairs {
public:
    /// @param filter null: all faces may touch others. Has to outlive this.
    FindObjectPairs(const Model& model, BroadPhase broad_phase, FaceFilter* filter = nullptr);
    /// Ends with the barriers that the next stage needs.
    void run(const ModelBuffers& model, const CollisionBuffers& collision, const NodeBuffers& nodes);

private:
    BroadPhase broad_phase_;
    FaceFilter* filter_;
    std::optional<ObjectTree> tree_;  // with hierarchy
    gl::Program count_program_, scan_program_, list_program_;
};

}  // namespace gelatin::gpu
