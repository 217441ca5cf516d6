#include "gpu/explicit/divide_and_merge.h"

namespace gelatin::gpu {

DivideAndMerge::DivideAndMerge(const Model& model, const ExplicitScheme& scheme, bool pulled)
    : write_program_(gl::Program::compute("sim/explicit/write_spring_forces.comp")),
      merge_program_(gl::Program::compute("sim/explicit/merge_spring_forces.comp")),
      integrate_program_(gl::Program::compute("sim/explicit/integrate_nodes.comp",
                                              integration_defines(model, scheme, pulled))),
      springs_(std::span(model.springs)),
      starts_(std::span(model.incidence.starts)),
      entries_(std::span(model.incidence.entries)),
      spring_forces_(model.springs.size()),
      node_forces_(model.positions.size()),
      node_count_(model.node_count()) {
    write_program_.bind("Springs", springs_);
    write_program_.bind("SpringForces", spring_forces_);
    write_program_.set("spring_count", static_cast<std::uint32_t>(springs_.size()));
    merge_program_.bind("SpringForces", spring_forces_);
    merge_program_.bind("Starts", starts_);
    merge_program_.bind("Entries", entries_);
    merge_program_.bind("NodeForces", node_forces_);
    merge_program_.set("node_count", node_count_);
    integrate_program_.bind("NodeForces", node_forces_);
}

void DivideAndMerge::write_spring_forces(const NodeBuffers& nodes) const {
    write_program_.bind("Positions", nodes.positions);
    write_program_.bind("Velocities", nodes.velocities);
    write_program_.dispatch(springs_.size());
    gl::barrier(gl::Barrier::storage);
}

void DivideAndMerge::merge_spring_forces() const {
    merge_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage);
}

void DivideAndMerge::run(const ModelBuffers& model, const Pass& pass) const {
    write_spring_forces(pass.at);
    merge_spring_forces();
    bind_integration(integrate_program_, model, pass);
    integrate_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
