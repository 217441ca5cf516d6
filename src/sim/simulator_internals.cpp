#include "sim/simulator_internals.h"

#include <cassert>

#include "gelatin/error.h"
#include "sim/backend.h"
#include "sim/simulator_impl.h"

namespace gelatin {

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Simulator::Impl::~Impl() {
    if (!context) return;
    try {
        context->make_current();
    } catch (const GlError& error) {
        log_debug(error.what());  // current on another thread: the driver keeps what it has until the end
    }
}

void Simulator::Impl::begin() {
    solver = make_solver(scene, model);
    if (start_state) solver->write_state(*start_state);
    watch.emplace(scene, model, substeps);
    drags.emplace(model);
    clocks.emplace(model);
    if (start_state) watch->begin(*start_state, {});
}

std::shared_ptr<const Model> SimulatorInternals::share_model(const Simulator& simulator) {
    return simulator.impl_->model;
}

std::shared_ptr<const Solver> SimulatorInternals::share_solver(const Simulator& simulator) {
    return simulator.impl_->solver;
}

void SimulatorInternals::make_current(Simulator& simulator) {
    if (simulator.impl_->context) simulator.impl_->context->make_current();
}

void SimulatorInternals::need_context(Simulator& simulator) {
    Impl& d = *simulator.impl_;
    if (d.context) return;
    SimulatorOptions options = d.options;
    options.need_gl = true;
    d.context = make_context(options);
}

Simulator SimulatorInternals::another(const Simulator& like) {
    const Impl& from = *like.impl_;
    assert(!from.context && from.pins.empty());
    auto impl = std::make_unique<Impl>();
    impl->scene = from.scene;
    impl->options = from.options;
    impl->model = impl->unpinned = from.model;
    impl->substeps = from.substeps;
    impl->start_state = from.start_state;
    impl->begin();
    return Simulator(std::move(impl));
}

}  // namespace gelatin
