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

}  // namespace

Session::Session(LoadedScene loaded, Backend backend, const Session* earlier)
    : simulator_(SimulatorInternals::make(loaded.scene, std::move(loaded.model), simulator_options(backend))),
      device_(simulator_.device()),
      pace_(simulator_.step_size()),
      held_nodes_(simulator_.held_nodes()) {
    if (earlier == nullptr) return;
    simulator_.go_on_from(earlier->simulator_);
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
    follow_hand();
    follow_drags();
    time_ = simulator_.time();
    frame_ = simulator_.frame();
}

void Session::go_back() {
    simulator_.reset();
    drags_asked_.clear();
    problem_.clear();
    readings_.clear();
    pace_.restart();
    is_view_old_ = true;
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
