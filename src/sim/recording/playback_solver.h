#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cpu/cpu_solver.h"
#include "sim/recording/recorded_frame.h"

namespace gelatin {

/// Has the state and the forces of a recorded frame, and simulates nothing.
class PlaybackSolver : public cpu::CpuSolver<float> {
public:
    /// Without contacts and implicit solver, whose tables nobody needs.
    explicit PlaybackSolver(std::shared_ptr<const Model> model)
        : CpuSolver(std::move(model), SolverKind::semi_implicit_euler, ForceMethod::fused) {}

    void show(const RecordedFrame& frame) {
        write_state(frame.moment.state);
        contacts_ = frame.contacts;
        holds_ = frame.holds;
    }
    void advance_nodes(double /*step*/) override {}
    ContactForces contact_forces() const override { return contacts_; }
    HoldingForces holding_forces() const override { return holds_; }
    std::vector<std::uint32_t> held_up(std::span<const HandlePose> /*poses*/) const override { return {}; }
    std::string device() const override { return "a recording"; }

private:
    ContactForces contacts_;
    HoldingForces holds_;
};

}  // namespace gelatin
