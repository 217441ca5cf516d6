#include "gpu/drive/apply_kinematics.h"

#include <algorithm>

namespace gelatin::gpu {
namespace {

std::size_t count_animated(const Model& model) {
    return static_cast<std::size_t>(
        std::count_if(model.handle_nodes.begin(), model.handle_nodes.end(),
                      [](const HandleNode& held) { return held.animated != packing::kNone; }));
}

}  // namespace

ApplyKinematics::ApplyKinematics(const Model& model)
    : program_(gl::Program::compute("sim/drive/apply_kinematics.comp")),
      handle_nodes_(std::span(model.handle_nodes)),
      motions_(model.handles.size()),
      animated_(std::max<std::size_t>(1, count_animated(model))) {}

void ApplyKinematics::run(std::span<const HandleMotion> motions, std::span<const NodeMotion> animated,
                          const NodeBuffers& nodes) {
    motions_.upload(motions);
    if (!animated.empty()) animated_.upload(animated);
    // Measuring and drawing may still be reading the nodes.
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    program_.bind("Positions", nodes.positions);
    program_.bind("Velocities", nodes.velocities);
    program_.bind("HandleNodes", handle_nodes_);
    program_.bind("Motions", motions_);
    program_.bind("Animated", animated_);
    program_.set("held_count", static_cast<std::uint32_t>(handle_nodes_.size()));
    program_.dispatch(handle_nodes_.size());
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
