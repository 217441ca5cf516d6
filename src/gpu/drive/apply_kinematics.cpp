#include "gpu/drive/apply_kinematics.h"

namespace gelatin::gpu {

ApplyKinematics::ApplyKinematics(const Model& model)
    : program_(gl::Program::compute("sim/drive/apply_kinematics.comp")),
      handle_nodes_(std::span(model.handle_nodes)),
      motions_(model.handles.size()) {}

void ApplyKinematics::run(std::span<const HandleMotion> motions, const NodeBuffers& nodes) {
    motions_.upload(motions);
    // Measuring and drawing may still be reading the nodes.
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    program_.bind("Positions", nodes.positions);
    program_.bind("Velocities", nodes.velocities);
    program_.bind("HandleNodes", handle_nodes_);
    program_.bind("Motions", motions_);
    program_.set("held_count", static_cast<std::uint32_t>(handle_nodes_.size()));
    program_.dispatch(handle_nodes_.size());
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
}

}  // namespace gelatin::gpu
