// Making a simulator, and going through time.
#include "gelatin/simulator.h"

#include <utility>

#include "model/assembly/build_model.h"
#include "sim/simulation.h"

namespace gelatin {

Simulator::Simulator(const Scene& scene, const SimulatorOptions& options)
    : Simulator(scene, std::make_shared<const Model>(build_model(scene)), options) {}

Simulator::Simulator(const Scene& scene, std::shared_ptr<const Model> model,
                     const SimulatorOptions& options) {
    validate(scene);
    impl_ = std::make_unique<Simulation>(scene, std::move(model), options);
}

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

// Callbacks may set others.
void Simulator::step() {
    if (const StepCallback call = impl_->before) call(*this);
    impl_->step();
    if (const StepCallback call = impl_->after) call(*this);
}

void Simulator::before_step(StepCallback callback) {
    impl_->before = std::move(callback);
}

void Simulator::after_step(StepCallback callback) {
    impl_->after = std::move(callback);
}

void Simulator::advance_frame() {
    const int steps = impl_->steps_a_frame();
    for (int s = 0; s < steps; ++s) step();
}

void Simulator::reset() {
    impl_->reset();
}

void Simulator::check() const {
    const auto host = impl_->keep_host_state_of_solver();
    const Moment now = impl_->clock.now();
    impl_->watch->check(impl_->solver->alarm(true), now, now);
}

int Simulator::frame() const {
    return impl_->clock.now().frame;
}
double Simulator::time() const {
    return impl_->clock.time();
}
int Simulator::substeps() const {
    return impl_->clock.substeps();
}
double Simulator::step_size() const {
    return impl_->clock.step_size();
}
bool Simulator::uses_gl() const {
    return impl_->solver.uses_gl();
}
std::string Simulator::backend() const {
    return uses_gl() ? "gl" : "cpu";
}
std::string Simulator::device() const {
    return impl_->solver->device();
}
const Scene& Simulator::scene() const {
    return impl_->scene;
}

}  // namespace gelatin
