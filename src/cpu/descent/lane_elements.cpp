#include "cpu/descent/lane_elements.h"

#include <utility>

namespace gelatin::cpu {

LaneElements::LaneElements(std::shared_ptr<const Model> model, DescentRows& rows, const NodeTets& node_tets)
    : model_(std::move(model)),
      has_damping_(model_->has_damping()),
      springs_(make_spring_blocks(rows)),
      tets_(make_tet_blocks(*model_, rows.nodes, node_tets, VolumesOf::springs)),
      colliders_(make_collider_bounds(model_->colliders)) {
    rows.springs = {};
    if (has_damping_) damped_springs_ = springs_;
    if (!model_->volume_term.is_empty()) bounds_ = VolumeBounds(*model_, tets_);
}

void LaneElements::begin(const DescentRows& rows, const StepState<float>& step) {
    if (has_damping_)
        damp_springs(springs_, rows.nodes, step.starts.data(), step.inverse_step, damped_springs_);
}

void LaneElements::update(const DescentRows& rows, const DescentBatch& batch, std::span<const float> ratios) {
    if (!model_->volume_term.is_empty()) bounds_.update(*model_, tets_, batch, rows.nodes, ratios);
}

}  // namespace gelatin::cpu
