#include "gpu/descent/descent_moves.h"

namespace gelatin::gpu {

DescentMoves::DescentMoves(const Model& model, bool has_coarse_level)
    : objective(model),
      contacts(model),
      sweep_program_(gl::Program::compute("sim/descent/descend.comp", StepObjective::defines(model))),
      rigid_move_(model, objective, contacts) {
    if (has_coarse_level) {
        const CoarseBasis basis = make_coarse_basis(model);
        if (basis.cluster_count() > 0) coarse_.emplace(model, basis, objective, contacts);
    }
    objective.bind(sweep_program_);
    contacts.bind(sweep_program_);
}

// The nodes' two buffers swap places from step to step.
void DescentMoves::begin(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
                         double step) {
    sweep_program_.bind("positions", current.position_texels);
    sweep_program_.bind("start_velocities", previous.velocity_texels);
    sweep_program_.bind("OutPositions", current.positions);
    sweep_program_.set("time_step", static_cast<float>(step));
    model.bind_colliders(sweep_program_);
    rigid_move_.begin(model, previous, current, step);
    if (coarse_) coarse_->begin(model, previous, current, step);
}

void DescentMoves::run(int sweeps, const NodeBuffers& current, StageTimer* timer) {
    const auto run_part = [&](const char* name, const auto& work) {
        const TimedStage part(timer, name);
        work();
    };
    for (int i = 0; i < sweeps; ++i) {
        if (const TetUpdate update = tet_update_before(i); update != TetUpdate::none)
            run_part("advance_nodes.update_tets", [&] { objective.update(update, gathering_programs()); });
        run_part("advance_nodes.descend", [&] { sweep(); });
        const bool is_last = i + 1 == sweeps;
        if (coarse_ && !is_last && i % kSweepsACorrection == 0)
            run_part("advance_nodes.correct", [&] { coarse_->run(current, rigid_move_); });
        if (is_last || (i + 1) % kSweepsAMotion == 0)
            run_part("advance_nodes.move_bodies", [&] { rigid_move_.run(is_last); });
    }
}

std::vector<const gl::Program*> DescentMoves::gathering_programs() const {
    std::vector<const gl::Program*> programs = {&sweep_program_};
    if (coarse_) programs.push_back(&coarse_->force_program());
    return programs;
}

// One colour after another.
void DescentMoves::sweep() const {
    for (const Range& rows : objective.colors()) {
        sweep_program_.set("first_row", rows.first);
        sweep_program_.set("row_count", rows.count);
        sweep_program_.dispatch(rows.count);
        gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
    }
}

}  // namespace gelatin::gpu
