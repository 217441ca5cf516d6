#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cpu/cpu_solver.h"
#include "sim/recording/recorded_frame.h"

namespace gelatin {

/// Has the state and the forces of a recorded frame, to draw and to measure.
class PlaybackSolver : public cpu::CpuSolver<float> {
public:
    explicit PlaybackSolver(std::shared_ptr<const Model> model) : CpuSolver(std::move(model), {}) {}

    void show(const RecordedFrame& frame) {
        write_state(frame.moment.state);
        contacts_ = frame.contacts;
        holds_ = frame.holds;
    }
    ContactForces contact_forces() override { return contacts_; }
    HoldingForces holding_forces() override { return holds_; }
    std::vector<std::uint32_t> held_up(std::span<const glm::dvec3> /*places*/) override { return {}; }
    std::string device() const override { return "a recording"; }

private:
    // Frames are shown, not computed.
    void advance_nodes(const Step& /*step*/) override {}

    ContactForces contacts_;
    HoldingForces holds_;
};

}  // namespace gelatin
