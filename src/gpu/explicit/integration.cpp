#include "gpu/explicit/integration.h"

#include "model/solver.h"

namespace gelatin::gpu {

gl::Defines integration_defines(const Model& model, const ExplicitScheme& scheme, bool pulled) {
    gl::Defines defines = ModelBuffers::collider_defines(model);
    if (scheme.pass_count > 1) defines.emplace_back("MULTI_PASS");
    if (!model.loads.empty()) defines.emplace_back("LOADED");
    if (pulled) defines.emplace_back("PULLED");
    for (const std::string& define : NeoHookeanBuffers::defines(model)) defines.push_back(define);
    for (const std::string& define : VolumeTermBuffers::defines(model)) defines.push_back(define);
    return defines;
}

void bind_integration(const gl::Program& program, const ModelBuffers& model, const Pass& pass) {
    program.bind("base_positions", pass.base.position_texels);
    program.bind("base_velocities", pass.base.velocity_texels);
    program.bind("positions", pass.at.position_texels);
    program.bind("velocities", pass.at.velocity_texels);
    program.bind("OutPositions", pass.out.positions);
    program.bind("OutVelocities", pass.out.velocities);
    model.bind_colliders(program);
    model.neo_hookean.bind(program);
    model.volume_term.bind(program);
    if (model.pulls) model.pulls->bind(program);
    if (pass.loads != nullptr) pass.loads->bind(program);
    if (pass.volume_stresses != nullptr) pass.volume_stresses->bind(program);

    const auto h = static_cast<float>(pass.step);
    if (pass.scheme.pass_count > 1) {
        program.bind("SumPositions", pass.sums.positions);
        program.bind("SumVelocities", pass.sums.velocities);
        const ExplicitScheme::Pass& weights = pass.scheme.passes[static_cast<std::size_t>(pass.index)];
        program.set("weight", static_cast<float>(weights.weight));
        program.set("next_step", h * static_cast<float>(weights.next));
        program.set("is_first", pass.index == 0 ? 1u : 0u);
        program.set("is_last", pass.is_last() ? 1u : 0u);
    }
    program.set("node_count", model.node_count);
    program.set("time_step", h);
    program.set("semi_implicit", pass.scheme.semi_implicit ? 1u : 0u);
    program.set("gravity", model.gravity);
    program.set("resting_speed", static_cast<float>(resting_speed(model.gravity, pass.step)));
}

}  // namespace gelatin::gpu
