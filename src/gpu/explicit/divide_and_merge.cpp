#include "gpu/explicit/divide_and_merge.h"

namespace gelatin::gpu {

DivideAndMerge::DivideAndMerge(const Model& model, const ExplicitScheme& scheme)
    : write_program_(gl::Program::compute("sim/explicit/write_spring_forces.comp")),
      merge_program_(gl::Program::compute("sim/explicit/merge_spring_forces.comp")),
      integrate_program_(
          gl::Program::compute("sim/explicit/integrate_nodes.comp", integration_defines(model, scheme))),
      springs_(std::span(model.springs)),
      starts_(std::span(model.incidence.starts)),
      entries_(std::span(model.incidence.entries)),
      spring_forces_(model.springs.size()),
      node_forces_(model.positions.size()),
      node_count_(model.node_count()) {}

void DivideAndMerge::write_spring_forces(const NodeBuffers& nodes) const {
    nodes.positions.bind_storage(0);
    nodes.velocities.bind_storage(1);
    springs_.bind_storage(2);
    spring_forces_.bind_storage(3);
    write_program_.set("spring_count", static_cast<std::uint32_t>(springs_.size()));
    write_program_.dispatch(springs_.size());
    gl::barrier(gl::Barrier::storage);
}

void DivideAndMerge::merge_spring_forces() const {
    spring_forces_.bind_storage(0);
    starts_.bind_storage(1);
    entries_.bind_storage(2);
    node_forces_.bind_storage(3);
    merge_program_.set("node_count", node_count_);
    merge_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::storage);
}

void DivideAndMerge::run(const ModelBuffers& model, const Pass& pass) const {
    write_spring_forces(pass.at);
    merge_spring_forces();
    bind_integration(integrate_program_, model, pass);
    node_forces_.bind_storage(4);
    integrate_program_.dispatch(node_count_);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
