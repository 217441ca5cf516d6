#include "gpu/implicit/step_state.h"

#include <algorithm>

namespace gelatin::gpu {

StepState::StepState(const Model& model, const ContactSurface& surface)
    : from(model.positions, model.velocities),
      to(model.positions, model.velocities),
      clock(std::vector<StepClock>(1)),
      paces(model.objects.size(), gl::TexelFormat::rgba32f),
      goals(model.positions.size(), gl::TexelFormat::rgba32f),
      predicted(model.positions.size(), gl::TexelFormat::rgba32f),
      accelerations(model.positions.size(), gl::TexelFormat::rgba32f),
      stiffness_(surface.stiffness, gl::TexelFormat::r32f),
      thicknesses_(std::vector<float>(surface.thicknesses.begin(), surface.thicknesses.end()),
                   gl::TexelFormat::r32f),
      masses_(model.masses, gl::TexelFormat::r32f),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      body_nodes_(model.body_node_count()) {
    const std::size_t planes = std::max<std::size_t>(model.colliders.size() * model.body_node_count(), 1);
    plane_memories = gl::Buffer<PlaneMemory>(std::vector<PlaneMemory>(planes));
    plane_notes = gl::Buffer<PlaneMemory>(std::vector<PlaneMemory>(planes));
}

void StepState::bind(const gl::Program& program) const {
    const auto bind_block = [&](const char* name, const auto& buffer) {
        if (program.declares(name)) program.bind(name, buffer);
    };
    const auto bind_both = [&](const char* block, const char* sampler, const auto& buffer) {
        bind_block(block, buffer.values);
        bind_block(sampler, buffer.texels);
    };
    bind_block("Clock", clock);
    bind_both("Paces", "paces", paces);
    bind_both("Goals", "goals", goals);
    bind_both("Predicted", "predicted", predicted);
    bind_both("Accelerations", "accelerations", accelerations);
    bind_block("PlaneMemories", plane_memories);
    bind_block("PlaneNotes", plane_notes);
    bind_block("node_stiffness", stiffness_);
    bind_block("thicknesses", thicknesses_);
    bind_block("masses", masses_);
    program.set("body_count", body_count_);
    program.set("body_nodes", body_nodes_);
}

}  // namespace gelatin::gpu
