#include "gelatin/simulator.h"

#include <cmath>
#include <utility>

#include "cpu/cpu_solver.h"
#include "gelatin/error.h"
#include "model/build/build_model.h"
#include "model/build/model_check.h"
#include "model/build/start_state.h"
#include "model/explicit/stability.h"
#include "sim/backend.h"
#include "sim/carry_over.h"
#include "sim/check_starts.h"
#include "sim/checkpoint.h"
#include "sim/recording/playback_solver.h"
#include "sim/recording/recording_internals.h"
#include "sim/shared_solver.h"
#include "sim/simulator_impl.h"
#include "sim/simulator_internals.h"

namespace gelatin {

std::unique_ptr<Solver> Simulator::Impl::make_solver(const Scene& of,
                                                     const std::shared_ptr<const Model>& from) const {
    if (recording) return std::make_unique<PlaybackSolver>(from);
    const SimulationSettings& settings = of.simulation;
    DescentSettings descent{settings.iterations};
    descent.divides_steps = of.has_contact() && !settings.substeps;
    descent.sleeps = of.has_contact() && settings.sleep;
    std::unique_ptr<Solver> made;
    if (choose_gl(options, context) && has_contacts(*from, of.collision)) {
        made = std::make_unique<SharedSolver>(from, settings.forces, of.collision, descent);
    } else if (choose_gl(options, context)) {
        made =
            std::make_unique<gpu::GpuSolver>(from, settings.solver, settings.forces, of.collision, descent);
    } else {
        made = std::make_unique<cpu::CpuSolver<float>>(from, settings.solver, settings.forces, of.collision,
                                                       descent);
    }
    made->stage_timer().time_parts(options.time_parts);
    return made;
}

Simulator::Simulator(const Scene& scene, const SimulatorOptions& options)
    : Simulator(scene, std::make_shared<const Model>(build_model(scene)), options) {}

Simulator::Simulator(const Scene& scene, std::shared_ptr<const Model> model, const SimulatorOptions& options)
    : impl_(std::make_unique<Impl>()) {
    validate(scene);
    Impl& d = *impl_;
    d.scene = scene;
    d.scene.collision.response = scene.collision.response_with(scene.simulation.solver);
    d.options = with_needed_backend(options, d.scene, *model);
    d.model = std::move(model);
    d.substeps = choose_substeps(scene, *d.model);
    d.unpinned = d.model;
    d.context = make_context(d.options);
    const auto host = d.keep_host_state();
    d.start_state = deformed_start(scene, *d.model);
    if (d.scene.has_contact()) d.start_apart();
    d.begin();
    for (const std::string& line : check_model(*d.model, scene, d.step_size())) log_warning(line);
    for (const std::string& line :
         check_starts(*d.model, scene, d.start_state ? d.start_state->positions : d.model->positions))
        log_warning(line);
}

Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

void Simulator::Impl::step() {
    if (recording) {
        if (shown + 1 < recording->frame_count()) show(shown + 1);
        return;
    }
    gl::forget_state();  // the application may have used OpenGL since
    const auto host = keep_host_state_of_solver();
    move_held_nodes();
    if (!model->loads.empty()) solver->set_load_factors(load_factors(model->loads, time(), step_size()));
    run_stage("advance_nodes", [&] { solver->advance_nodes(step_size()); });
    // Contacts are part of advance_nodes.
    const bool is_apart = scene.has_contact();
    const bool has_others = model->objects.size() > 1, meets_others = has_others && !is_apart;
    const bool meets_itself = scene.collision.self_collision.value_or(false) && !is_apart;
    if (meets_others || meets_itself || seeks_proximities())
        run_stage("update_boxes", [&] { solver->update_boxes(); });
    if (meets_others || (has_others && seeks_proximities()))
        run_stage("find_object_pairs", [&] { solver->find_object_pairs(); });
    if (meets_others) run_stage("find_face_collisions", [&] { solver->find_face_collisions(); });
    if (meets_itself) run_stage("find_self_collisions", [&] { solver->find_self_collisions(); });
    if (seeks_proximities()) run_stage("find_proximities", [&] { solver->find_proximities(); });
    if (meets_others || meets_itself) run_stage("respond", [&] { solver->respond(step_size()); });
    ++steps;
    ++revision;
    const Moment end = now();
    look_for_standstills();
    run_stage("watch_nodes", [&] {
        solver->watch_nodes(static_cast<std::uint32_t>(end.steps), watch->most_energy(end.time));
    });
    // A GPU is queried once a frame.
    if (gpu_solver() == nullptr || steps % static_cast<std::uint64_t>(substeps) == 0)
        watch->check(solver->alarm(false), end, end);
}

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

void Simulator::reset() {
    Impl& d = *impl_;
    if (d.recording) return d.show(0);
    const auto host = d.keep_host_state_of_solver();
    if (!d.pins.empty()) d.rebuild(d.scene, d.unpinned, {});
    d.drags->restart();
    d.clocks->restart();
    d.take_state(d.first_state(), {});
}

void Simulator::go_on_from(const Simulator& other) {
    Impl& d = *impl_;
    d.require_no_playback();
    const auto host = d.keep_host_state_of_solver();
    const int frame = static_cast<int>(other.time() * scene().simulation.frame_rate + 1e-6);
    const State state =
        carried_over(*other.impl_->model, other.impl_->solver->read_state(), *d.model, d.first_state());
    const std::vector<double>& delays = other.impl_->clocks->delays();
    d.clocks->go_on_with(carried_over(*other.impl_->model, delays, *d.model));
    d.drags = carried_over(*other.impl_->model, *other.impl_->drags, *d.model, state,
                           d.clocks->times(other.time()), Drags(d.model));
    d.take_state(state, {frame, other.time(),
                         static_cast<std::uint64_t>(frame) * static_cast<std::uint64_t>(substeps())});
}

std::vector<HeldNodes> Simulator::held_nodes() const {
    const Impl& d = *impl_;
    std::vector<HeldNodes> all;
    for (std::size_t h = 0; h < d.model->handles.size(); ++h) {
        const Handle& handle = d.model->handles[h];
        if (!d.model->is_body(handle.object)) break;  // colliders come last
        const HandlePose pose = d.pose_of(h);
        const bool is_released = !is_held(handle, time() - d.clocks->delays()[h], step_size());
        all.push_back({handle.object, handle.is_pin, handle.index, handle.count, is_released,
                       pose.place(handle.middle), pose.center, d.drags->drags()[h], d.drags->targets()[h]});
    }
    return all;
}

void Simulator::drag(std::size_t held, const Drag& target) {
    impl_->require_no_playback();
    impl_->drags->set_target(held, target);
}

void Simulator::check() const {
    const auto host = impl_->keep_host_state_of_solver();
    impl_->watch->check(impl_->solver->alarm(true), impl_->now(), impl_->now());
}

void Simulator::advance_frame() {
    const int steps = impl_->recording ? 1 : impl_->substeps;
    for (int s = 0; s < steps; ++s) step();
}

int Simulator::frame() const {
    return impl_->frame();
}
double Simulator::time() const {
    return impl_->time();
}
int Simulator::substeps() const {
    return impl_->substeps;
}
double Simulator::step_size() const {
    return impl_->step_size();
}
bool Simulator::uses_gl() const {
    return impl_->gpu_solver() != nullptr;
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
std::unique_ptr<gl::HostState> SimulatorInternals::keep_host_state(const Simulator& simulator) {
    return simulator.impl_->keep_host_state();
}
const Model& SimulatorInternals::model(const Simulator& simulator) {
    return *simulator.impl_->model;
}
Simulator SimulatorInternals::make(const Scene& scene, std::shared_ptr<const Model> model,
                                   const SimulatorOptions& options) {
    return {scene, std::move(model), options};
}

Counts Simulator::counts() const {
    const Model& m = *impl_->model;
    return {m.body_count(), m.positions.size(), m.springs.size(), m.faces.size(), m.tets.size()};
}

RenderView Simulator::render_view(const Overlays& overlays) {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    if (!d.context)
        throw NoOpenGl("drawing needs an OpenGL context: request it with SimulatorOptions::need_gl");
    const auto host = d.keep_host_state();
    if (!d.draw_source) d.draw_source.emplace(d.model);
    RenderView view;
    gpu::GpuSolver* const on_gpu = d.gpu_solver();
    if (on_gpu != nullptr) {
        d.run_stage("update_normals", [&] { view = d.draw_source->update(*on_gpu, overlays); });
    } else {
        view = d.draw_source->update(d.solver->read_state(), overlays);
    }
    if (!overlays.any()) return view;
    if (!d.overlay_source) d.overlay_source.emplace(d.model);
    d.run_stage("update_overlays", [&] {
        view.overlay =
            on_gpu != nullptr
                ? d.overlay_source->update(overlays, view, *on_gpu)
                : d.overlay_source->update(overlays, view, dynamic_cast<cpu::CpuSolver<float>&>(*d.solver));
    });
    return view;
}

void Simulator::save_checkpoint(const std::filesystem::path& file) const {
    check();
    const auto host = impl_->keep_host_state_of_solver();
    write_checkpoint(file, *impl_->model, impl_->checkpoint());
}

namespace {

// @param frame of a recording; empty: its last one
Checkpoint read_moment(const std::filesystem::path& file, std::optional<int> frame, const Model& model) {
    if (!is_recording(file)) return read_checkpoint(file, model);
    const Recording recording(file);
    RecordingInternals::require_fits(recording, model);
    const std::size_t index = frame ? recording.index_of(*frame) : recording.frame_count() - 1;
    return RecordingInternals::frame(recording, model, index).moment;
}

// Pins of programs are no part of checkpoints: those of this simulation count, and none that held nodes when
// the checkpoint was saved. Handles that release their nodes have done so or not, as the checkpoint has it.
void hold_as_here(const Model& model, std::vector<glm::vec4>& positions) {
    std::vector<std::uint8_t> may_be_free(positions.size());
    for (const HandleNode& held : model.handle_nodes)
        may_be_free[held.node] = std::isinf(model.handles[held.handle].release) ? 0 : 1;
    for (std::size_t n = 0; n < positions.size(); ++n)
        if (may_be_free[n] == 0) positions[n].w = model.positions[n].w;
}

}  // namespace

void Simulator::load_checkpoint(const std::filesystem::path& file, std::optional<int> frame) {
    Impl& d = *impl_;
    d.require_no_playback();
    Checkpoint checkpoint = read_moment(file, frame, *d.model);
    const auto host = d.keep_host_state_of_solver();
    hold_as_here(*d.model, checkpoint.state.positions);
    d.drags->go_on_with(checkpoint.drags, checkpoint.drag_targets);
    d.clocks->go_on_with(checkpoint.delays);
    d.take_state(checkpoint.state, d.moment_of(checkpoint));
}

}  // namespace gelatin
