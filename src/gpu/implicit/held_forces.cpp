#include "gpu/implicit/held_forces.h"

#include "model/drive/holding_forces.h"

namespace gelatin::gpu {

HeldForces::HeldForces(const Model& model, const StepState& state, const StepSystem& system)
    : model_(model),
      state_(state),
      system_(system),
      program_(gl::Program::compute("sim/implicit/held_forces.comp", SumLoads::defines(model))),
      forces_(std::vector<glm::vec4>(model.node_count())) {
    bind_buffers();
}

void HeldForces::bind_buffers() const {
    state_.bind(program_);
    system_.buffers().bind(program_);
    system_.elastic.bind_product(program_, system_.buffers().displacements.texels);
    program_.bind("positions", state_.from.position_texels);
    program_.bind("ElasticForces", system_.elastic.forces());
    program_.bind("HeldForces", forces_);
    program_.set("body_node_count", model_.body_node_count());
}

HoldingForces HeldForces::read(const ModelBuffers& buffers, const SumLoads* loads, double size) const {
    if (size == 0.0) return find_holding_forces<float>(model_, model_.positions, {}, {});
    if (loads != nullptr) loads->bind(program_);
    buffers.pulls.bind(program_);
    gl::barrier(gl::Barrier::storage | gl::Barrier::texture_fetch);
    program_.dispatch(model_.body_node_count());
    std::vector<glm::dvec3> others, accelerations;
    for (const glm::vec4& force : gpu::read(forces_)) others.emplace_back(force);
    const std::vector<glm::vec4> changes = gpu::read(state_.held_changes.values);
    for (const HandleNode& held : model_.handle_nodes)
        accelerations.push_back(glm::dvec3(changes[held.node]) / size);
    const std::vector<glm::vec4> positions = gpu::read(state_.from.positions);
    return find_holding_forces<float>(model_, positions, others, accelerations);
}

}  // namespace gelatin::gpu
