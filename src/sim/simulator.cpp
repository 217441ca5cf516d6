#include "gelatin/simulator.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <deque>

#include "core/current_stage.h"
#include "core/log.h"
#include "cpu/cpu_solver.h"
#include "gelatin/error.h"
#include "gl/object_name.h"
#include "gpu/gpu_solver.h"
#include "model/build/build_model.h"
#include "model/build/model_check.h"
#include "model/build/start_state.h"
#include "model/drive/drags.h"
#include "model/drive/handle_clocks.h"
#include "model/explicit/stability.h"
#include "sim/backend.h"
#include "sim/carry_over.h"
#include "sim/check_starts.h"
#include "sim/checkpoint.h"
#include "sim/draw_source.h"
#include "sim/forces.h"
#include "sim/move_apart.h"
#include "sim/overlay_source.h"
#include "sim/shared_solver.h"
#include "sim/simulator_internals.h"
#include "sim/standstills.h"
#include "sim/watch.h"

namespace gelatin {

struct Simulator::Impl {
    Scene scene;
    SimulatorOptions options;
    std::optional<gl::Context> context;  // declared before everything that owns GL objects
    std::shared_ptr<const Model> model;
    int substeps = 1;
    std::unique_ptr<Solver> solver;
    std::optional<DrawSource> draw_source;
    std::optional<OverlaySource> overlay_source;
    std::optional<State> start_state;  // if it is not the model's

    Moment start{0, 0.0, 0};  // of this run: where a checkpoint was loaded
    std::uint64_t steps = 0;  // since then
    std::optional<Watch> watch;
    std::optional<Drags> drags;
    std::optional<HandleClocks> clocks;
    Standstills standstills;
    bool is_pulled = false;
    std::deque<Moment> measured;
    std::deque<std::vector<ContactForce>> measured_forces;  // of the same, with contact
    std::deque<std::vector<HoldingForce>> measured_holds;
    std::uint32_t reported_losses = 0;
    bool lost_proximities = false;  // and reported

    void make_solver() {
        const SimulationSettings& settings = scene.simulation;
        DescentSettings descent{settings.iterations};
        descent.divides_steps = scene.has_contact() && !settings.substeps;
        if (choose_gl(options, context) && has_contacts(*model, scene.collision)) {
            solver = std::make_unique<SharedSolver>(model, settings.forces, scene.collision, descent);
        } else if (choose_gl(options, context)) {
            solver = std::make_unique<gpu::GpuSolver>(model, settings.solver, settings.forces,
                                                      scene.collision, descent);
        } else {
            solver = std::make_unique<cpu::CpuSolver<float>>(model, settings.solver, settings.forces,
                                                             scene.collision, descent);
        }
        solver->stage_timer().time_parts(options.time_parts);
    }

    /// The solver in OpenGL; null: the CPU simulates.
    gpu::GpuSolver* gpu_solver() const { return dynamic_cast<gpu::GpuSolver*>(solver.get()); }

    // Counted from the start, so that a resumed run has exactly the times of an uninterrupted one.
    void go_on_from(const Moment& moment) {
        start = moment;
        steps = 0;
        const auto whole = static_cast<std::uint64_t>(std::llround(moment.time / step_size()));
        const bool same_steps =
            moment.frame == static_cast<int>(whole / static_cast<std::uint64_t>(substeps)) &&
            std::abs(static_cast<double>(whole) * step_size() - moment.time) <= 1e-6 * step_size();
        if (!same_steps) return;
        start = {0, 0.0, 0};
        steps = whole;
    }

    double step_size() const { return scene.simulation.frame_time() / substeps; }
    int frame() const { return start.frame + static_cast<int>(steps / static_cast<std::uint64_t>(substeps)); }
    double time() const { return start.time + static_cast<double>(steps) * step_size(); }
    Moment now() const { return {frame(), time(), start.steps + steps}; }

    bool seeks_proximities() const {
        return scene.collision.proximity_radius &&
               (model->objects.size() > 1 || scene.collision.self_collision);
    }

    bool has_contact_forces() const { return scene.has_contact(); }

    ProximityStatistics take_proximities() {
        const ProximityMeasure measure = solver->proximities();
        if (measure.lost > 0 && !lost_proximities) {
            log_warning(fmt::format(
                "{} proximities were not stored: too many for the GPU's buffers; choose a smaller "
                "proximity_radius",
                measure.lost));
            lost_proximities = true;
        }
        return {measure.node_face, measure.edge_edge, measure.lost, measure.nearest};
    }

    State first_state() const { return start_state.value_or(State{model->positions, model->velocities, {}}); }

    // Bodies that never pass through each other have to be apart when they start.
    void start_apart() {
        State state = first_state();
        if (std::optional<MovedApart> moved = move_apart(model, state.positions)) {
            for (const std::string& line : moved->lines) log_warning(line);
            state.positions = std::move(moved->positions);
            require_apart(model, scene, state.positions);  // both may be held
            start_state = std::move(state);
        }
        if (scene.collision.self_collision)
            require_whole(model, scene, start_state ? start_state->positions : model->positions);
    }

    // Makes what a run changes. @pre all that it is made of is there
    void begin() {
        make_solver();
        if (start_state) solver->write_state(*start_state);
        watch.emplace(scene, model, substeps);
        drags.emplace(model);
        clocks.emplace(model);
        if (start_state) watch->begin(*start_state, {});
    }

    // Continues from this state. Pending measurements belong to the old one.
    void take_state(const State& state, const Moment& moment) {
        for (; !measured.empty(); measured.pop_front()) solver->end_measure();
        standstills.restart();
        measured_forces.clear();
        measured_holds.clear();
        solver->write_state(state);
        go_on_from(moment);
        watch->begin(state, now());
        clocks->set_held_up(find_held_up());
    }

    // The work of a user's pull or drag is unknown, and the watch does not know of handles that are late.
    void move_held_nodes() {
        if (is_pulled || drags->is_under_way()) watch->note_hand(time() + step_size());
        if (!drags->may_move()) return;
        const HandleTimes times = clocks->advance(time(), step_size());
        if (clocks->late_ones_act(times, step_size())) watch->note_hand(time() + step_size());
        const std::vector<HandleMotion> motions = drags->advance(times, step_size());
        run_stage("apply_kinematics", [&] { solver->apply_kinematics(motions); });
    }

    HandlePose pose_of(std::size_t handle) const {
        return pose_at(model->handles[handle], time() - clocks->delays()[handle], drags->drags()[handle]);
    }

    std::vector<std::uint32_t> find_held_up() const {
        if (!drags->may_move() || !has_contact_forces()) return {};
        std::vector<HandlePose> poses;
        for (std::size_t h = 0; h < model->handles.size(); ++h) poses.push_back(pose_of(h));
        return solver->held_up(poses);
    }

    void look_for_standstills() {
        const std::vector<std::uint32_t> held_up = find_held_up();
        clocks->set_held_up(held_up);
        for (const std::string& line : standstills.look(*model, *solver, held_up, clocks->delays(), time()))
            log_warning(line);
    }

    void warn_of_lost_pairs() {
        const std::uint32_t lost = solver->lost_pairs();
        if (lost == reported_losses) return;
        log_warning(fmt::format(
            "{} pairs of objects or faces were not tested for collision: too many for the GPU's buffers",
            lost - reported_losses));
        reported_losses = lost;
    }

    template <class Work>
    void run_stage(const char* name, const Work& work) {
        const CurrentStage stage(name);
        const TimedStage timed(options.time_stages ? &solver->stage_timer() : nullptr, name);
        work();
    }
};

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
    d.context = make_context(d.options);
    d.start_state = deformed_start(scene, *d.model);
    if (d.scene.has_contact()) d.start_apart();
    d.begin();
    for (const std::string& line : check_model(*d.model, scene, d.step_size())) log_warning(line);
    for (const std::string& line :
         check_starts(*d.model, scene, d.start_state ? d.start_state->positions : d.model->positions))
        log_warning(line);
}

Simulator::Simulator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;
Simulator::~Simulator() = default;

void Simulator::step() {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    d.move_held_nodes();
    if (!d.model->loads.empty())
        d.solver->set_load_factors(load_factors(d.model->loads, d.time(), d.step_size()));
    d.run_stage("advance_nodes", [&] { d.solver->advance_nodes(d.step_size()); });
    // Contacts are part of advance_nodes.
    const bool is_apart = d.scene.has_contact();
    const bool has_others = d.model->objects.size() > 1, meets_others = has_others && !is_apart;
    const bool meets_itself = d.scene.collision.self_collision && !is_apart;
    if (meets_others || meets_itself || d.seeks_proximities())
        d.run_stage("update_boxes", [&] { d.solver->update_boxes(); });
    if (meets_others || (has_others && d.seeks_proximities()))
        d.run_stage("find_object_pairs", [&] { d.solver->find_object_pairs(); });
    if (meets_others) d.run_stage("find_face_collisions", [&] { d.solver->find_face_collisions(); });
    if (meets_itself) d.run_stage("find_self_collisions", [&] { d.solver->find_self_collisions(); });
    if (d.seeks_proximities()) d.run_stage("find_proximities", [&] { d.solver->find_proximities(); });
    if (meets_others || meets_itself) d.run_stage("respond", [&] { d.solver->respond(d.step_size()); });
    ++d.steps;
    const Moment now = d.now();
    d.look_for_standstills();
    d.run_stage("watch_nodes", [&] {
        d.solver->watch_nodes(static_cast<std::uint32_t>(now.steps), d.watch->most_energy(now.time));
    });
    // A GPU is queried once a frame.
    if (!uses_gl() || d.steps % static_cast<std::uint64_t>(d.substeps) == 0)
        d.watch->check(d.solver->alarm(false), now, now);
}

void Simulator::reset() {
    impl_->drags->restart();
    impl_->clocks->restart();
    impl_->take_state(impl_->first_state(), {});
}

void Simulator::go_on_from(const Simulator& other) {
    Impl& d = *impl_;
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

void Simulator::set_pull(const std::optional<Pull>& pull) {
    impl_->is_pulled = pull.has_value();
    impl_->solver->set_pull(pull);
}

void Simulator::move_pull(const glm::dvec3& target) {
    impl_->solver->move_pull(target);
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
    impl_->drags->set_target(held, target);
}

void Simulator::check() const {
    impl_->watch->check(impl_->solver->alarm(true), impl_->now(), impl_->now());
}

void Simulator::advance_frame() {
    for (int s = 0; s < impl_->substeps; ++s) step();
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
const Model& SimulatorInternals::model(const Simulator& simulator) {
    return *simulator.impl_->model;
}
const Solver& SimulatorInternals::solver(const Simulator& simulator) {
    return *simulator.impl_->solver;
}
void SimulatorInternals::make_current(Simulator& simulator) {
    if (simulator.impl_->context) simulator.impl_->context->make_current();
}
Simulator SimulatorInternals::make(const Scene& scene, std::shared_ptr<const Model> model,
                                   const SimulatorOptions& options) {
    return {scene, std::move(model), options};
}
Simulator SimulatorInternals::another(const Simulator& like) {
    assert(!like.impl_->context);
    auto impl = std::make_unique<Simulator::Impl>();
    impl->scene = like.impl_->scene;
    impl->options = like.impl_->options;
    impl->model = like.impl_->model;
    impl->substeps = like.impl_->substeps;
    impl->start_state = like.impl_->start_state;
    impl->begin();
    return Simulator(std::move(impl));
}

Counts Simulator::counts() const {
    const Model& m = *impl_->model;
    return {m.body_count(), m.positions.size(), m.springs.size(), m.faces.size(), m.tets.size()};
}

void Simulator::begin_statistics() {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    d.run_stage("measure", [&] { d.solver->begin_measure(); });
    d.measured.push_back(d.now());
    if (d.has_contact_forces()) d.measured_forces.push_back(contact_forces(d.scene, *d.model, *d.solver));
    d.measured_holds.push_back(holding_forces(*d.model, *d.solver));
}

std::size_t Simulator::pending_statistics() const {
    return impl_->measured.size();
}

FrameStatistics Simulator::take_statistics() {
    Impl& d = *impl_;
    const std::vector<ObjectMeasure> objects = d.solver->end_measure();
    const Moment moment = d.measured.front();
    d.measured.pop_front();
    d.watch->check(d.solver->alarm(false), moment, d.now());
    d.watch->check(objects, moment);
    FrameStatistics frame;
    frame.frame = moment.frame;
    frame.time = moment.time;
    d.warn_of_lost_pairs();
    if (d.seeks_proximities()) frame.proximities = d.take_proximities();
    if (d.has_contact_forces()) {
        frame.contact_forces = std::move(d.measured_forces.front());
        d.measured_forces.pop_front();
    }
    frame.holding_forces = std::move(d.measured_holds.front());
    d.measured_holds.pop_front();
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const ObjectMeasure& object = objects[o];
        frame.kinetic_energy += object.kinetic_energy;
        frame.elastic_energy += object.elastic_energy;
        frame.potential_energy += object.potential_energy;
        for (int k = 0; k < 3; ++k) frame.momentum[k] += object.momentum[k];
        frame.contacts += object.contacts;
        frame.colliding_faces += object.colliding_faces;
        frame.deepest_penetration = std::max(frame.deepest_penetration, object.deepest_penetration);
        if (d.model->is_body(o))
            frame.volume_ratio.push_back(object.volume / d.model->objects[o].rest_volume);
    }
    return frame;
}

std::vector<std::pair<std::string, std::vector<double>>> Simulator::take_stage_times() {
    const StageTimes times = impl_->solver->stage_timer().take();
    return {times.begin(), times.end()};
}

HostFrame Simulator::read_frame() const {
    const State state = impl_->solver->read_state();
    HostFrame host;
    host.frame = frame();
    host.time = time();
    for (const glm::vec4& p : state.positions) host.positions.insert(host.positions.end(), {p.x, p.y, p.z});
    for (const glm::vec4& v : state.velocities)
        host.velocities.insert(host.velocities.end(), {v.x, v.y, v.z});
    for (const glm::dvec3& force : impl_->solver->holding_forces().nodes)
        for (int k = 0; k < 3; ++k) host.holding_forces.push_back(static_cast<float>(force[k]));
    if (!impl_->has_contact_forces()) return host;
    const ContactForces forces = impl_->solver->contact_forces();
    for (std::size_t n = 0; n < forces.normal.size(); ++n) {
        const glm::vec3 friction(forces.friction[n]), force(forces.normal[n] + forces.friction[n]);
        host.contact_forces.insert(host.contact_forces.end(), {force.x, force.y, force.z});
        host.contact_friction.insert(host.contact_friction.end(), {friction.x, friction.y, friction.z});
    }
    return host;
}

RenderView Simulator::render_view(const Overlays& overlays) {
    gl::forget_state();  // the application may have used OpenGL since
    Impl& d = *impl_;
    if (!d.context)
        throw NoOpenGl("drawing needs an OpenGL context: request it with SimulatorOptions::need_gl");
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
    const Drags& drags = *impl_->drags;
    write_checkpoint(file, *impl_->model,
                     {frame(), time(), impl_->solver->read_state(), drags.drags(), drags.targets(),
                      impl_->clocks->delays()});
}

void Simulator::load_checkpoint(const std::filesystem::path& file) {
    const Checkpoint checkpoint = read_checkpoint(file, *impl_->model);
    impl_->drags->go_on_with(checkpoint.drags, checkpoint.drag_targets);
    impl_->clocks->go_on_with(checkpoint.delays);
    impl_->take_state(checkpoint.state, {checkpoint.frame, checkpoint.time,
                                         static_cast<std::uint64_t>(checkpoint.frame) *
                                             static_cast<std::uint64_t>(substeps())});
}

}  // namespace gelatin
