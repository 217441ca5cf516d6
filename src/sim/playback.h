#pragma once

#include <memory>

#include "gelatin/recording.h"
#include "sim/recording/playback_solver.h"
#include "sim/simulator_impl.h"

namespace gelatin {

/// A Simulator that plays a recording: each step goes to the next recorded frame, if there is one.
struct Playback final : SimulatorInternals::Impl {
    std::shared_ptr<const Recording> recording;
    std::size_t shown = 0;  // of its frames

    /// @throws InvalidInput if the model is not the recording's
    Playback(std::shared_ptr<const Recording> of, const std::shared_ptr<const Model>& from,
             const SimulatorOptions& with);

    void step() override;
    void reset() override { show(0); }
    int steps_a_frame() const override { return 1; }
    [[noreturn]] Simulation& simulation() override;
    Playback* playback() override { return this; }
    /// As the recorded frame has them, made when they are first asked for.
    const MadeAttachments& made_attachments() override;
    std::string attachments_memory() const override { return attachments_memory_; }

    /// As of a recorded frame. Measurements of others stay pending.
    void show(std::size_t index);

private:
    std::shared_ptr<PlaybackSolver> frames_;
    std::string attachments_memory_;
    std::optional<MadeAttachments> attachments_;  // as of some frame
    std::string made_memory_;                     // of that
};

}  // namespace gelatin
