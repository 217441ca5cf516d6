#include "sim/simulation.h"

#include <cassert>
#include <utility>

#include "core/log.h"
#include "core/stage.h"
#include "cpu/make_solver.h"
#include "gl/program.h"
#include "gpu/make_solver.h"
#include "model/assembly/attachments.h"
#include "model/assembly/model_check.h"
#include "model/assembly/start_state.h"
#include "model/explicit/stability.h"
#include "sim/backend.h"
#include "sim/check_starts.h"
#include "sim/move_apart.h"
#include "sim/shared_solver.h"

namespace gelatin {

Simulation::Simulation(const Scene& of, std::shared_ptr<const Model> from, const SimulatorOptions& with)
    : Impl(of, from, with, choose_substeps(of, *from)), unpinned(std::move(from)) {
    options = with_needed_backend(with, scene, *model);
    context = make_context(options);
    const auto host = keep_host_state();
    start_state = deformed_start(scene, *model);
    if (scene.has_contact()) {
        State state = first_state();
        if (move_bodies_apart(state.positions, "at the start")) start_state = std::move(state);
    }
    attachments = MadeAttachments(scene, *model, first_state().positions);
    begin();
    for (const std::string& line : check_model(*model, of, clock.step_size())) log_warning(line);
    for (const std::string& line : check_starts(*model, of, first_state().positions)) log_warning(line);
}

Simulation::Simulation(const Simulation& like)
    : Impl(like.scene, like.model, like.options, like.clock.substeps()),
      start_state(like.start_state),
      unpinned(like.unpinned),
      attachments(scene, *model, first_state().positions) {
    assert(!like.context && like.pins.empty());
    begin();
}

void Simulation::begin() {
    solver = make_solver(scene, model);
    set_attachments();
    if (!start_state) return;
    solver->write_state(*start_state);
    watch->begin(*start_state, {});
}

BackendSolver Simulation::make_solver(const Scene& of, const std::shared_ptr<const Model>& from) const {
    const SimulationSettings& settings = of.simulation;
    ImplicitSettings implicit{settings.iterations};
    implicit.divides_steps = of.has_contact() && !settings.substeps;
    implicit.sleeps = of.has_contact() && settings.sleep;
    const auto timed = [&](auto made) {
        made->stage_timer().time_stages(options.time_stages);
        made->stage_timer().time_parts(options.time_parts);
        return BackendSolver(std::move(made));
    };
    if (!choose_gl(options, context))
        return timed(std::shared_ptr(
            cpu::make_solver<float>(from, settings.solver, settings.forces, of.collision, implicit)));
    // Attachments, gas and rigid bodies are in the host's steps alone.
    if (attachments.all.empty() && from->cavities.empty() && !from->has_rigid_bodies() &&
        (!has_contacts(*from, of.collision) || makes_contacts_on_device()))
        return timed(std::shared_ptr(
            gpu::make_solver(from, settings.solver, settings.forces, of.collision, implicit)));
    return timed(
        std::shared_ptr<gpu::GpuSolver>(std::make_shared<SharedSolver>(from, of.collision, implicit)));
}

void Simulation::step() {
    gl::forget_state();  // the application may have used OpenGL since
    const auto host = keep_host_state_of_solver();
    const double size = clock.step_size();
    const HeldMotions held = move_held_nodes();
    const std::vector<float> factors = load_factors(model->loads, clock.time(), size);
    const std::vector<MotorTarget> targets = find_motors();
    const std::vector<double> cavity_drives = find_cavity_drives();
    solver->advance({size, held.handles, held.animated, factors, targets, cavity_drives});
    clock.count_step();
    ++revision;
    look_for_standstills();
    look_for_broken();
    const Moment end = clock.now();
    {
        const Stage stage(solver->stage_timer(), "watch_nodes");
        solver->watch_nodes(static_cast<std::uint32_t>(end.steps), watch->most_energy(end.time));
    }
    // A GPU is queried once a frame.
    if (!solver.uses_gl() || clock.is_at_end_of_frame()) watch->check(solver->alarm(false), end, end);
}

// The work of a user's pull or drag is unknown, and the watch does not know of handles that are late.
Simulation::HeldMotions Simulation::move_held_nodes() {
    const double time = clock.time(), size = clock.step_size();
    if (!pulls.empty() || !forces.empty() || drags.is_under_way() || arms.is_under_way(time))
        watch->note_hand(time + size);
    if (!drags.may_move()) return {};
    const HandleTimes times = handle_clocks.advance(time, size);
    if (handle_clocks.late_ones_act(times, size)) watch->note_hand(time + size);
    const std::vector<Drag> before = drags.drags();
    HeldMotions motions{drags.advance(times, size), {}};
    motions.animated = arms.motions(before, drags.drags(), times, size);
    return motions;
}

// The watch does not know how much energy they may give, nor what springs of joints hold.
std::vector<MotorTarget> Simulation::find_motors() {
    std::vector<MotorTarget> targets(attachments.all.size());
    for (std::size_t a = 0; a < targets.size(); ++a) {
        const auto set = motors.find(a);
        const AttachmentDescription& description = scene.attachments[a];
        const bool is_driven = set != motors.end() || description.motor;
        if (is_driven || description.spring) watch->note_hand(clock.time() + clock.step_size());
        if (!is_driven) continue;
        targets[a] =
            motor_at(description, set != motors.end() ? set->second : *description.motor, clock.time());
    }
    return targets;
}

std::vector<std::uint32_t> Simulation::find_held_up() const {
    if (!drags.may_move() || !has_contact_forces()) return {};
    std::vector<HandlePose> poses;
    for (std::size_t h = 0; h < model->handles.size(); ++h) poses.push_back(pose_of(h));
    return solver->held_up(arms.places(poses, handle_clocks.times(clock.time())));
}

void Simulation::look_for_standstills() {
    const std::vector<std::uint32_t> held_up = find_held_up();
    handle_clocks.set_held_up(held_up);
    for (const std::string& line :
         standstills.look(*model, *solver, held_up, handle_clocks.delays(), clock.time()))
        log_warning(line);
}

void Simulation::reset() {
    const auto host = keep_host_state_of_solver();
    if (!pins.empty()) rebuild(scene, unpinned, {});
    drags.restart();
    handle_clocks.restart();
    arms.restart();
    motors.clear();
    cavity_gas.clear();
    attachments.reset(scene);
    set_attachments();
    take_state(first_state(), {});
}

State Simulation::first_state() const {
    return start_state.value_or(State{model->positions, model->velocities, {}});
}

void Simulation::discard_pending() {
    for (; !pending.empty(); pending.pop_front()) solver->end_measure();
}

void Simulation::take_state(const State& state, const Moment& moment) {
    discard_pending();
    standstills.restart();
    solver->write_state(state);
    const std::vector<AttachmentForce> found = solver->attachment_forces();
    for (std::size_t a = 0; a < found.size(); ++a) attachments.all[a].is_broken = found[a].is_broken;
    ++revision;
    clock.go_on_from(moment);
    watch->begin(state, clock.now());
    handle_clocks.set_held_up(find_held_up());
}

bool Simulation::move_bodies_apart(std::vector<glm::vec4>& positions, const char* when) const {
    const JoinedBodies joined = joined_bodies(scene, *model);
    std::optional<MovedApart> moved = move_apart(model, positions, joined, when);
    if (moved) {
        require_apart(model, scene, moved->positions, joined, when);  // both may be held
        for (const std::string& line : moved->lines) log_warning(line);
        positions = std::move(moved->positions);
    }
    if (scene.collision.self_collision_with(scene.simulation.solver))
        for (const std::string& line : find_tangled(model, positions, when)) log_warning(line);
    return moved.has_value();
}

}  // namespace gelatin
