// Continuing from other moments: of a file, or of another simulation.
#include <fmt/core.h>

#include <cmath>

#include "core/log.h"
#include "gelatin/error.h"
#include "sim/carry_over.h"
#include "sim/checkpoint.h"
#include "sim/own_handles.h"
#include "sim/recording/recording_internals.h"
#include "sim/simulation.h"

namespace gelatin {
namespace {

// @param frame of a recording; empty: its last one
Checkpoint read_moment(const std::filesystem::path& file, std::optional<int> frame, const Model& model) {
    if (!is_recording(file)) return read_checkpoint(file, model);
    const Recording recording(file);
    RecordingInternals::require_fits(recording, model);
    const std::size_t last = recording.frame_count() - 1, index = frame ? recording.index_of(*frame) : last;
    if (!frame && recording.is_cut_off())
        log_warning(fmt::format("{}: is cut off or damaged after frame {}, from which the run goes on",
                                file.string(), recording.frame(last)));
    return RecordingInternals::frame(recording, model, index).moment;
}

// Pins of programs are no part of checkpoints: those of this simulation count, and none that held nodes when
// the checkpoint was saved. Handles that release their nodes have done so or not, as the checkpoint has it.
void hold_as_here(const Model& model, std::vector<glm::vec4>& positions) {
    std::vector<std::uint8_t> may_be_free(positions.size());
    for (const HandleNode& held : model.handle_nodes)
        may_be_free[held.node] = std::isinf(model.handles[held.handle].release) ? 0 : 1;
    for (std::size_t n = 0; n < positions.size(); ++n)
        if (may_be_free[n] == 0) positions[n].w = model.positions[n].w;
}

}  // namespace

void Simulator::save_checkpoint(const std::filesystem::path& file) const {
    check();
    const auto host = impl_->keep_host_state_of_solver();
    Checkpoint checkpoint = impl_->checkpoint();
    checkpoint.state.memory = impl_->solver->memory();
    write_checkpoint(file, *impl_->model, checkpoint);
}

void Simulator::load_checkpoint(const std::filesystem::path& file, std::optional<int> frame) {
    Simulation& d = impl_->simulation();
    Checkpoint checkpoint = read_moment(file, frame, *d.unpinned);
    Simulator::Impl::Programmed programmed = d.programmed_of(checkpoint, file);
    const auto host = d.keep_host_state_of_solver();
    const bool had_some = !d.attachments.all.empty();
    try {
        d.attachments.restore(programmed.attachments, d.scene, *d.model);
    } catch (const InvalidInput& error) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, std::string("does not fit the scene: ") + error.what()});
    }
    d.set_attachments(had_some);
    hold_as_here(*d.model, checkpoint.state.positions);
    d.drags.go_on_with(with_own_handles(*d.model, checkpoint.drags, d.drags.drags()),
                       with_own_handles(*d.model, checkpoint.drag_targets, d.drags.targets()));
    d.handle_clocks.go_on_with(with_own_handles(*d.model, checkpoint.delays, d.handle_clocks.delays()));
    d.arms = std::move(programmed.arms);
    d.motors = std::move(programmed.motors);
    d.motors.erase(d.motors.lower_bound(d.attachments.all.size()), d.motors.end());
    d.cavity_gas = std::move(programmed.cavity_gas);
    d.take_state(checkpoint.state, d.moment_of(checkpoint));
}

void Simulator::go_on_from(const Simulator& other) {
    Simulation& d = impl_->simulation();
    Impl& from = *other.impl_;
    const auto host = d.keep_host_state_of_solver();
    const bool had_some = !d.attachments.all.empty();
    d.attachments.go_on_from(from.made_attachments(), from.scene, *from.model, d.first_state(), d.scene,
                             *d.model);
    d.set_attachments(had_some);
    const double time = from.clock.time();
    const int frame = static_cast<int>(time * d.scene.simulation.frame_rate + 1e-6);
    const State state = carried_over(*from.model, from.solver->read_state(), *d.model, d.first_state());
    d.handle_clocks.go_on_with(carried_over(*from.model, from.handle_clocks.delays(), *d.model));
    d.drags =
        carried_over(*from.model, from.drags, *d.model, state, d.handle_clocks.times(time), Drags(d.model));
    d.arms = HandleArms(d.model, carried_over(*from.model, from.arms.programmed(), *d.model));
    d.cavity_gas = carried_over(*from.model, from.cavity_gas, *d.model);
    d.motors = carried_over(from.scene, from.motors, d.scene);
    d.take_state(state,
                 {frame, time, static_cast<std::uint64_t>(frame) * static_cast<std::uint64_t>(substeps())});
}

}  // namespace gelatin
