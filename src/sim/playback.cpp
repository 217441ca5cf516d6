#include "sim/playback.h"

#include <string>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "model/assembly/build_model.h"
#include "model/explicit/stability.h"
#include "sim/backend.h"
#include "sim/recording/recording_internals.h"

namespace gelatin {

Playback::Playback(std::shared_ptr<const Recording> of, const std::shared_ptr<const Model>& from,
                   const SimulatorOptions& with)
    : Impl(of->scene(), from, with, choose_substeps(of->scene(), *from)), recording(std::move(of)) {
    options.backend = Backend::cpu;
    context = make_context(options);
    RecordingInternals::require_fits(*recording, *model);
    frames_ = std::make_shared<PlaybackSolver>(model);
    solver = BackendSolver(frames_);
    show(0);
}

void Playback::step() {
    if (shown + 1 < recording->frame_count()) show(shown + 1);
}

Simulation& Playback::simulation() {
    throw InvalidInput("this simulator plays a recording: nothing in it can be changed");
}

const MadeAttachments& Playback::made_attachments() {
    if (attachments_ && made_memory_ == attachments_memory_) return *attachments_;
    made_memory_ = attachments_memory_;
    try {
        if (!attachments_) {
            attachments_.emplace();
            const RecordedFrame& first = RecordingInternals::frame(*recording, *model, 0);
            attachments_ = MadeAttachments(scene, *model, first.moment.state.positions);
        }
        if (attachments_->of_scene == recording->scene().attachments.size())
            attachments_->restore(made_memory_, scene, *model);
    } catch (const InvalidInput& error) {  // it begins in the middle of a run
        log_warning(std::string("attachments are not drawn: ") + error.what());
    }
    return *attachments_;
}

void Playback::show(std::size_t index) {
    const RecordedFrame& frame = RecordingInternals::frame(*recording, *model, index);
    Programmed programmed = programmed_of(frame.moment, recording->file());
    shown = index;
    ++revision;
    frames_->show(frame);
    drags.go_on_with(frame.moment.drags, frame.moment.drag_targets);
    handle_clocks.go_on_with(frame.moment.delays);
    arms = std::move(programmed.arms);
    motors = std::move(programmed.motors);
    attachments_memory_ = std::move(programmed.attachments);
    cavity_gas = std::move(programmed.cavity_gas);
    clock.go_on_from(moment_of(frame.moment));
    watch->begin(frame.moment.state, clock.now());
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): read before it is moved, in whichever order
Simulator::Simulator(std::shared_ptr<const Recording> recording, const SimulatorOptions& options)
    : Simulator(recording, std::make_shared<const Model>(build_model(recording->scene())), options) {}

// NOLINTNEXTLINE(performance-unnecessary-value-param): the model is shared
Simulator::Simulator(std::shared_ptr<const Recording> recording, std::shared_ptr<const Model> model,
                     const SimulatorOptions& options)
    : impl_(std::make_unique<Playback>(std::move(recording), model, options)) {}

const Recording* Simulator::recording() const {
    const Playback* const playback = impl_->playback();
    return playback != nullptr ? playback->recording.get() : nullptr;
}

void Simulator::show_recorded(std::size_t index) {
    impl_->playback()->show(index);
}

}  // namespace gelatin
