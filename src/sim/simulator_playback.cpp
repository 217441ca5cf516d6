#include <utility>

#include "gelatin/recording.h"
#include "model/build/build_model.h"
#include "model/explicit/stability.h"
#include "sim/backend.h"
#include "sim/recording/playback_solver.h"
#include "sim/recording/recording_internals.h"
#include "sim/simulator_impl.h"
#include "sim/simulator_internals.h"

namespace gelatin {

Simulator::Simulator(std::shared_ptr<const Recording> recording, const SimulatorOptions& options)
    : Simulator(recording, std::make_shared<const Model>(build_model(recording->scene())), options) {}

Simulator::Simulator(std::shared_ptr<const Recording> recording, std::shared_ptr<const Model> model,
                     const SimulatorOptions& options)
    : impl_(std::make_unique<Impl>()) {
    Impl& d = *impl_;
    d.recording = std::move(recording);
    d.scene = d.recording->scene();
    d.scene.collision.response = d.scene.collision.response_with(d.scene.simulation.solver);
    d.options = options;
    d.options.backend = Backend::cpu;
    d.model = d.unpinned = std::move(model);
    d.substeps = choose_substeps(d.scene, *d.model);
    d.context = make_context(d.options);
    RecordingInternals::require_fits(*d.recording, *d.model);
    d.begin();
    d.show(0);
}

void Simulator::Impl::show(std::size_t index) {
    const RecordedFrame& frame = RecordingInternals::frame(*recording, *model, index);
    shown = index;
    ++revision;
    dynamic_cast<PlaybackSolver&>(*solver).show(frame);
    drags->go_on_with(frame.moment.drags, frame.moment.drag_targets);
    clocks->go_on_with(frame.moment.delays);
    go_on_from(moment_of(frame.moment));
    watch->begin(frame.moment.state, now());
}

const Recording* Simulator::recording() const {
    return impl_->recording.get();
}

void Simulator::show_recorded(std::size_t index) {
    impl_->show(index);
}

Simulator SimulatorInternals::make(std::shared_ptr<const Recording> recording,
                                   std::shared_ptr<const Model> model, const SimulatorOptions& options) {
    return {std::move(recording), std::move(model), options};
}

RecordedFrame SimulatorInternals::recorded_frame(const Simulator& simulator) {
    const Simulator::Impl& d = *simulator.impl_;
    const auto host = d.keep_host_state_of_solver();
    RecordedFrame frame{d.checkpoint(), {}, d.solver->holding_forces()};
    if (d.has_contact_forces()) frame.contacts = d.solver->contact_forces();
    return frame;
}

}  // namespace gelatin
