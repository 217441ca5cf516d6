#include "gpu/descent/coarse_step.h"

namespace gelatin::gpu {
namespace {

gl::Defines force_defines(const Model& model) {
    gl::Defines defines = StepObjective::defines(model);
    defines.emplace_back("FORCES");
    return defines;
}

}  // namespace

CoarseStep::CoarseStep(const Model& model, const CoarseBasis& basis, const StepObjective& objective,
                       const ColliderContacts& contacts)
    : force_program_(gl::Program::compute("sim/descent/descend.comp", force_defines(model))),
      row_count_(objective.row_count()),
      correction_(model, basis) {
    objective.bind(force_program_);
    contacts.bind(force_program_);
}

void CoarseStep::begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                       double step) {
    force_program_.set("time_step", static_cast<float>(step));
    force_program_.bind("start_velocities", previous.velocity_texels);
    force_program_.bind("OutPositions", current.positions);  // in the source, though not written with FORCES
    model.bind_colliders(force_program_);
    correction_.begin(current, step);
}

void CoarseStep::run(const NodeBuffers& nodes, const RigidMove& bodies) {
    correction_.bind_forces(force_program_, false);
    force_program_.bind("positions", nodes.position_texels);
    force_program_.set("is_ahead", 0u);
    find_forces();
    correction_.find_displacements();

    correction_.bind_forces(force_program_, true);
    force_program_.bind("positions", correction_.ahead_texels());
    force_program_.set("is_ahead", 1u);
    find_forces();
    correction_.apply_displacements(bodies.chunks(), bodies.chunk_starts());
}

void CoarseStep::find_forces() const {
    force_program_.set("first_row", 0u);
    force_program_.set("row_count", row_count_);
    force_program_.dispatch(row_count_);
    gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
}

}  // namespace gelatin::gpu
