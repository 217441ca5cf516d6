#include "session.h"

#include <algorithm>
#include <utility>

#include "gelatin/error.h"

namespace gelatin::viewer {
namespace {

constexpr double kMeasureInterval = 0.05;  // [s]

SimulatorOptions simulator_options(Backend backend) {
    SimulatorOptions options;
    options.backend = backend;
    options.use_current_context = true;
    options.time_stages = true;
    return options;
}

Simulator make_simulator(LoadedScene loaded, Backend backend) {
    const SimulatorOptions options = simulator_options(backend);
    if (loaded.recording)
        return SimulatorInternals::make(std::move(loaded.recording), std::move(loaded.model), options);
    return SimulatorInternals::make(loaded.scene, std::move(loaded.model), options);
}

// From one step, or recorded frame, to the next [s].
double step_of(const Simulator& simulator) {
    const Recording* const recording = simulator.recording();
    if (recording == nullptr) return simulator.step_size();
    return recording->frame_count() > 1 ? recording->time(1) - recording->time(0)
                                        : simulator.scene().simulation.frame_time();
}

}  // namespace

Session::Session(LoadedScene loaded, Backend backend, const Session* earlier)
    : simulator_(make_simulator(std::move(loaded), backend)),
      device_(simulator_.device()),
      pace_(step_of(simulator_)),
      held_nodes_(simulator_.held_nodes()),
      attachments_(simulator_.attachments()),
      own_attachments_(simulator_.scene().attachments.size()),
      cavities_(simulator_.cavities()) {
    if (earlier == nullptr) return;
    simulator_.go_on_from(earlier->simulator_);
    attachments_ = simulator_.attachments();
    for (const auto& [attachment, motor] : earlier->motors_)
        if (attachment < attachments_.size()) motors_[attachment] = motor;
    gas_ = earlier->gas_;
    cavities_ = simulator_.cavities();
    held_nodes_ = simulator_.held_nodes();
    pace_.set_speed(earlier->pace_.speed());
    readings_ = earlier->readings_;
    is_playing_ = earlier->is_playing_;
    last_update_ = earlier->last_update_;
    time_ = earlier->time_;
    frame_ = earlier->frame_;
}

void Session::play(bool is_playing) {
    if (is_playing && !is_playing_) pace_.restart();
    const Recording* const played = recording();
    if (is_playing && played != nullptr && index_ + 1 == played->frame_count()) show_recorded(0);
    is_playing_ = is_playing && problem_.empty();
}

void Session::reset() {
    is_reset_asked_ = true;
    steps_asked_ = 0;
}

void Session::show(const Overlays& overlays) {
    overlays_ = overlays;
    is_view_old_ = true;
}

bool Session::update(double now) {
    if (is_computing()) return false;
    take_over();
    const bool is_new = is_view_old_;
    if (is_view_old_) {
        view_ = simulator_.render_view(overlays_);
        is_view_old_ = false;
    }
    const double elapsed = now - std::exchange(last_update_, now);
    if (!problem_.empty()) steps_asked_ = 0;
    int steps = std::min(steps_asked_, pace_.most_steps());
    steps_asked_ -= steps;
    if (is_playing_) steps += pace_.steps_for(elapsed);
    if (steps > 0) start_batch(steps, now);
    return is_new;
}

void Session::take_over() {
    try {
        worker_.rethrow();
        while (simulator_.pending_statistics() > 0) measured_.push_back(simulator_.take_statistics());
    } catch (const Error& error) {
        fail(error.what());
    }
    const double step_ms = readings_.add_stages(simulator_.take_stage_times());
    if (step_ms > 0.0) pace_.note_cost(1e-3 * step_ms);
    for (const FrameStatistics& statistics : std::exchange(measured_, {})) readings_.add(statistics);
    if (std::exchange(is_reset_asked_, false)) go_back();
    if (simulator_.recording() != nullptr) {
        follow_recording();
    } else {
        follow_hand();
        follow_drags();
        follow_attachments();
        follow_cavities();
    }
    cavities_ = simulator_.cavities();
    time_ = simulator_.time();
    frame_ = simulator_.frame();
}

void Session::go_back() {
    simulator_.reset();
    drags_asked_.clear();
    detached_.clear();
    motors_.clear();
    motors_asked_.clear();
    gas_.clear();
    gas_asked_.clear();
    problem_.clear();
    readings_.clear();
    pace_.restart();
    is_view_old_ = true;
}

// Nobody can take hold of what has happened already.
void Session::follow_recording() {
    hand_ = Hand::free;
    drags_asked_.clear();
    attach_tool_.cancel();
    const Recording& recording = *simulator_.recording();
    if (index_asked_) {
        try {
            simulator_.show_recorded(*index_asked_);
        } catch (const Error& error) {
            fail(error.what());
        }
        index_asked_.reset();
        is_view_old_ = true;
    }
    index_ = recording.index_of(simulator_.frame());
    if (index_ + 1 == recording.frame_count()) is_playing_ = false;
}

void Session::reach(const Ray& ray) {
    let_go();
    hand_ = Hand::reaching;
    reach_ = ray;
}

void Session::let_go() {
    hand_ = Hand::free;
}

void Session::follow_hand() {
    if (is_pulled_ && hand_ != Hand::holding) {
        simulator_.set_pulls({});
        is_pulled_ = false;
    }
    if (hand_ == Hand::reaching) {
        const std::vector<float> positions = simulator_.read_frame().positions;
        const std::optional<Pick> found =
            pick(reach_, drawn_positions(model(), positions), drawn_faces(model()));
        const bool is_body = found && model().is_body(found->object);  // or a collider
        hand_ = is_body ? Hand::holding : Hand::free;
        if (!is_body) return;
        held_point_ = hand_target_ = found->point;
        pull_ = take_hold(model(), positions, *found);
        simulator_.set_pulls({pull_});
        is_pulled_ = true;
    } else if (hand_ == Hand::holding) {
        simulator_.move_pull(0, glm::dvec3(hand_target_));
    }
}

void Session::drag(std::size_t held, const Drag& target) {
    drags_asked_.emplace_back(held, target);
}

void Session::follow_drags() {
    for (const auto& [held, target] : std::exchange(drags_asked_, {})) simulator_.drag(held, target);
    held_nodes_ = simulator_.held_nodes();
}

void Session::follow_attachments() {
    try {
        change_attachments();
    } catch (const InvalidInput& error) {
        refusal_ = error.what();
    }
    attachments_ = simulator_.attachments();
}

void Session::change_attachments() {
    for (const std::size_t attachment : std::exchange(detached_, {})) {
        simulator_.detach(attachment);
        is_view_old_ = true;
    }
    for (const auto& [attachment, motor] : std::exchange(motors_asked_, {})) {
        simulator_.set_motor(attachment, motor);
        motors_[attachment] = motor;
    }
    if (std::optional<std::string> made = attach_tool_.follow(simulator_)) {
        news_ = std::move(*made);
        is_view_old_ = true;
    }
}

void Session::follow_cavities() {
    try {
        for (const auto& [cavity, gas] : std::exchange(gas_asked_, {})) {
            simulator_.set_cavity(cavity, gas);
            gas_[cavity] = gas;
        }
    } catch (const InvalidInput& error) {
        refusal_ = error.what();
    }
}

CavityGas Session::cavity_gas(std::size_t cavity) const {
    const auto asked = gas_asked_.find(cavity), set = gas_.find(cavity);
    if (asked != gas_asked_.end()) return asked->second;
    if (set != gas_.end()) return set->second;
    const Cavity& of = model().cavities[cavity];
    const double drive = of.drive_at(time_, std::nullopt);
    return of.gas.law == GasLaw::constant ? CavityGas{.pressure = drive} : CavityGas{.amount = drive};
}

void Session::save_gas(Scene& scene) const {
    for (const auto& [cavity, gas] : gas_) {
        const std::size_t object = model().cavities[cavity].object;
        CavityDescription& saved =
            scene.objects[object].cavities[cavity - model().objects[object].cavities.first];
        saved.pressure = gas.pressure.value_or(saved.pressure);
        saved.amount = gas.amount.value_or(saved.amount);
        saved.keyframes.clear();
    }
}

std::optional<JointMotor> Session::motor(std::size_t attachment) const {
    const auto asked = motors_asked_.find(attachment), set = motors_.find(attachment);
    if (asked != motors_asked_.end()) return asked->second;
    if (set != motors_.end()) return set->second;
    return scene().attachments[attachment].motor;
}

Scene Session::own_scene() const {
    Scene own = scene();
    own.attachments.resize(own_attachments_);
    return own;
}

std::vector<AttachmentDescription> Session::attachments_to_save() const {
    std::vector<AttachmentDescription> saved = own_scene().attachments;
    for (const auto& [attachment, motor] : motors_)
        if (attachment < saved.size()) saved[attachment].motor = motor;
    if (attachments_.size() <= own_attachments_) return saved;
    const std::span<const Attachment> made = SimulatorInternals::attachments(simulator_);
    for (std::size_t a = own_attachments_; a < attachments_.size(); ++a)
        if (!attachments_[a].is_broken)
            saved.push_back(moved_attachment(scene().attachments[a], made[a], model(), model().positions));
    return saved;
}

void Session::start_batch(int steps, double now) {
    const bool measure = now - last_measure_ >= kMeasureInterval;
    if (measure) last_measure_ = now;
    is_view_old_ = true;
    if (!simulator_.uses_gl()) return worker_.start([=, this] { run_batch(steps, measure); });
    try {
        run_batch(steps, measure);
    } catch (const Error& error) {
        fail(error.what());
    }
    fence_ = gl::Fence::insert();
}

void Session::run_batch(int steps, bool measure) {
    for (int s = 0; s < steps; ++s) simulator_.step();
    if (measure) simulator_.begin_statistics();
}

void Session::fail(const std::string& problem) {
    problem_ = problem;
    is_playing_ = false;
}

}  // namespace gelatin::viewer
