#include "gpu/collision/find_object_pairs.h"

namespace gelatin::gpu {
namespace {

template <class T>
std::uint32_t capacity(const gl::Buffer<T>& buffer) {
    return static_cast<std::uint32_t>(buffer.size());
}

gl::Defines search_defines(BroadPhase broad_phase) {
    if (broad_phase == BroadPhase::hierarchy) return {"OBJECT_TREE"};
    if (broad_phase == BroadPhase::depth) return CullByDepth::defines();
    return {};
}

}  // namespace

FindObjectPairs::FindObjectPairs(const Model& model, BroadPhase broad_phase)
    : broad_phase_(broad_phase),
      count_program_(
          gl::Program::compute("sim/collision/count_object_pairs.comp", search_defines(broad_phase))),
      scan_program_(gl::Program::compute("sim/collision/scan_pair_rows.comp")),
      list_program_(
          gl::Program::compute("sim/collision/list_object_pairs.comp", search_defines(broad_phase))) {
    if (broad_phase == BroadPhase::hierarchy) tree_.emplace(model);
    if (broad_phase == BroadPhase::depth) cull_by_depth_.emplace(model);
}

void FindObjectPairs::run(const ModelBuffers& model, const CollisionBuffers& collision,
                          const NodeBuffers& nodes) {
    if (cull_by_depth_) cull_by_depth_->run(model, collision, nodes);
    if (tree_) tree_->update(collision);
    for (const gl::Program* program : {&count_program_, &list_program_}) {
        if (tree_) tree_->bind(*program);
        collision.bind_hidden(*program);
        collision.bind_pairs(*program);
        program->set("object_count", collision.object_count);
        program->set("ignore_boxes", broad_phase_ == BroadPhase::none ? 1u : 0u);
    }
    count_program_.dispatch(collision.object_count);
    gl::barrier(gl::Barrier::storage);

    collision.bind_pairs(scan_program_);
    scan_program_.set("object_count", collision.object_count);
    scan_program_.set("node_count", model.node_count);
    scan_program_.set("pair_capacity", capacity(collision.object_pairs));
    scan_program_.set("word_capacity", capacity(collision.face_collisions));
    scan_program_.dispatch_groups(1);
    gl::barrier(gl::Barrier::storage);

    list_program_.set("all_faces", walks_trees(broad_phase_) ? 0u : 1u);
    list_program_.set("candidate_capacity", capacity(collision.candidates));
    list_program_.dispatch(collision.object_count);
    gl::barrier(gl::Barrier::storage | gl::Barrier::command);
}

}  // namespace gelatin::gpu
