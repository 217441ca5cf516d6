#include "gpu/collision/find_face_collisions.h"

namespace gelatin::gpu {
namespace {

gl::Defines test_defines(CollisionDetection detection) {
    return detection == CollisionDetection::continuous ? gl::Defines{"CONTINUOUS"} : gl::Defines{};
}

}  // namespace

FindFaceCollisions::FindFaceCollisions(const CollisionSettings& settings, const FaceFilter* filter)
    : walks_(walks_trees(settings.broad_phase)),
      filter_(filter),
      list_program_(compile_filtered(filter, "list_candidates.comp")),
      scan_program_(gl::Program::compute("sim/collision/scan_tests.comp")),
      cull_program_(gl::Program::compute(walks_ ? "sim/collision/walk_trees.comp"
                                                : "sim/collision/cull_face_pairs.comp")),
      test_program_(
          gl::Program::compute("sim/collision/test_face_pairs.comp", test_defines(settings.detection))) {}

void FindFaceCollisions::run(const ModelBuffers& model, const CollisionBuffers& collision,
                             const NodeBuffers& previous, const NodeBuffers& nodes) const {
    using Work = CollisionBuffers::Work;
    const auto capacity = static_cast<std::uint32_t>(collision.face_pairs.size());
    collision.bind_pairs();
    if (filter_ != nullptr) filter_->bind();
    collision.face_boxes.bind_storage(3);
    collision.face_collisions.bind_storage(4);
    collision.candidates.bind_storage(5);
    collision.face_pairs.bind_storage(7);
    list_program_.set("object_count", collision.object_count);
    collision.run(list_program_, Work::entries);
    gl::barrier(gl::Barrier::storage);

    scan_program_.set("walk_trees", walks_ ? 1u : 0u);
    collision.run(scan_program_, Work::scan);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    collision.face_trees.node_texels.bind(1);
    collision.face_trees.box_texels.bind(2);
    collision.face_trees.root_texels.bind(3);
    cull_program_.set("face_pair_capacity", capacity);
    collision.run(cull_program_, Work::tests);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);

    nodes.position_texels.bind(0);
    previous.position_texels.bind(1);
    model.faces.bind_storage(3);
    test_program_.set("face_pair_capacity", capacity);
    collision.run(test_program_, Work::face_pairs);
    gl::barrier(gl::Barrier::storage);
}

}  // namespace gelatin::gpu
