#include "gpu/collision/find_face_collisions.h"

#include "gpu/depth/cull_by_depth.h"

namespace gelatin::gpu {
namespace {

gl::Defines list_defines(BroadPhase broad_phase) {
    return broad_phase == BroadPhase::depth ? CullByDepth::defines() : gl::Defines{};
}

gl::Defines test_defines(CollisionDetection detection) {
    return detection == CollisionDetection::continuous ? gl::Defines{"CONTINUOUS"} : gl::Defines{};
}

}  // namespace

FindFaceCollisions::FindFaceCollisions(const CollisionSettings& settings)
    : walks_(walks_trees(settings.broad_phase)),
      list_program_(
          gl::Program::compute("sim/collision/list_candidates.comp", list_defines(settings.broad_phase))),
      scan_program_(gl::Program::compute("sim/collision/scan_tests.comp")),
      cull_program_(gl::Program::compute(walks_ ? "sim/collision/walk_trees.comp"
                                                : "sim/collision/cull_face_pairs.comp")),
      test_program_(
          gl::Program::compute("sim/collision/test_face_pairs.comp", test_defines(settings.detection))) {}

void FindFaceCollisions::run(const ModelBuffers& model, const CollisionBuffers& collision,
                             const NodeBuffers& previous, const NodeBuffers& nodes) const {
    const auto capacity = static_cast<std::uint32_t>(collision.face_pairs.size());
    for (const gl::Program* program : {&list_program_, &scan_program_, &cull_program_, &test_program_})
        collision.bind_pairs(*program);

    collision.bind_hidden(list_program_);
    list_program_.bind("FaceBoxes", collision.face_boxes);
    list_program_.bind("FaceCollisions", collision.face_collisions);
    list_program_.bind("Candidates", collision.candidates);
    list_program_.set("object_count", collision.object_count);
    collision.run(list_program_, dispatch_slots::kEntries);
    gl::barrier(gl::Barrier::storage);

    scan_program_.set("walk_trees", walks_ ? 1u : 0u);
    collision.run(scan_program_, dispatch_slots::kScan);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    if (walks_) collision.face_trees.bind(cull_program_);
    cull_program_.bind("FaceBoxes", collision.face_boxes);
    cull_program_.bind("Candidates", collision.candidates);
    cull_program_.bind("FacePairs", collision.face_pairs);
    cull_program_.set("face_pair_capacity", capacity);
    collision.run(cull_program_, dispatch_slots::kTests);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    test_program_.bind("positions", nodes.position_texels);
    test_program_.bind("previous_positions", previous.position_texels);
    test_program_.bind("Faces", model.faces);
    test_program_.bind("FacePairs", collision.face_pairs);
    test_program_.bind("FaceCollisions", collision.face_collisions);
    test_program_.set("face_pair_capacity", capacity);
    collision.run(test_program_, dispatch_slots::kFacePairs);
    gl::barrier(gl::Barrier::storage);
}

}  // namespace gelatin::gpu
