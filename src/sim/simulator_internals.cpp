#include "sim/simulator_internals.h"

#include <algorithm>
#include <utility>

#include "sim/own_handles.h"
#include "sim/playback.h"
#include "sim/simulation.h"

namespace gelatin {

const Model& SimulatorInternals::model(const Simulator& simulator) {
    return *simulator.impl_->model;
}

std::span<const Attachment> SimulatorInternals::attachments(const Simulator& simulator) {
    return simulator.impl_->made_attachments().all;
}

std::shared_ptr<const Model> SimulatorInternals::share_model(const Simulator& simulator) {
    return simulator.impl_->model;
}

std::shared_ptr<const Solver> SimulatorInternals::share_solver(const Simulator& simulator) {
    return simulator.impl_->solver.shared();
}

Simulator SimulatorInternals::make(const Scene& scene, std::shared_ptr<const Model> model,
                                   const SimulatorOptions& options) {
    return {scene, std::move(model), options};
}

Simulator SimulatorInternals::make(std::shared_ptr<const Recording> recording,
                                   std::shared_ptr<const Model> model, const SimulatorOptions& options) {
    return {std::move(recording), std::move(model), options};
}

Simulator SimulatorInternals::another(const Simulator& like) {
    return Simulator(std::make_unique<Simulation>(like.impl_->simulation()));
}

RecordedFrame SimulatorInternals::recorded_frame(const Simulator& simulator) {
    const Impl& d = *simulator.impl_;
    const auto host = d.keep_host_state_of_solver();
    RecordedFrame frame{d.checkpoint(), d.solver->contact_forces(), d.solver->holding_forces()};
    for (auto* of_handles : {&frame.holds.by_handle, &frame.holds.torques})
        *of_handles = of_own_handles(*d.model, *of_handles);
    return frame;
}

Scene SimulatorInternals::own_scene(const Simulator& simulator) {
    Scene own = simulator.scene();
    own.attachments.resize(std::min(own.attachments.size(), simulator.impl_->made_attachments().of_scene));
    return own;
}

}  // namespace gelatin
