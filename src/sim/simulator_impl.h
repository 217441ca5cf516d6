#pragma once

#include <fmt/core.h>

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/current_stage.h"
#include "core/log.h"
#include "gelatin/error.h"
#include "gelatin/recording.h"
#include "gelatin/simulator.h"
#include "gl/context.h"
#include "gl/host_state.h"
#include "gl/object_name.h"
#include "gpu/gpu_solver.h"
#include "model/drive/drags.h"
#include "model/drive/handle_clocks.h"
#include "model/drive/with_pins.h"
#include "sim/checkpoint.h"
#include "sim/draw_source.h"
#include "sim/overlay_source.h"
#include "sim/standstills.h"
#include "sim/watch.h"

namespace gelatin {

/// What Simulator's spans of a state refer to, where the solver has none on the host.
struct StateCopies {
    std::optional<std::uint64_t> nodes_revision, forces_revision;  // of the state that they are of
    std::vector<glm::vec4> positions, velocities, contact_forces;
    std::vector<glm::uvec3> faces;  // of the model
};

/// All that a Simulator owns.
struct Simulator::Impl {
    Scene scene;
    SimulatorOptions options;
    std::optional<gl::Context> context;  // declared before everything that owns GL objects
    std::shared_ptr<const Model> model;
    int substeps = 1;
    std::shared_ptr<Solver> solver;  // shared by who reads its nodes
    std::optional<DrawSource> draw_source;
    std::optional<OverlaySource> overlay_source;
    std::optional<State> start_state;  // if it is not the model's

    std::shared_ptr<const Model> unpinned;  // the model without the pins of programs
    std::vector<AddedPin> pins;
    std::vector<Pull> pulls;
    std::vector<glm::vec3> forces;  // [N], shape [nodes]; empty: none
    StepCallback before, after;

    std::shared_ptr<const Recording> recording;  // that is played; null: it simulates
    std::size_t shown = 0;                       // of its frames

    Moment start{0, 0.0, 0};  // of this run: where a checkpoint was loaded
    std::uint64_t steps = 0;  // since then
    std::optional<Watch> watch;
    std::optional<Drags> drags;
    std::optional<HandleClocks> clocks;
    Standstills standstills;
    std::uint64_t revision = 0;  // of the state
    mutable StateCopies copies;
    std::deque<Moment> measured;
    std::deque<std::vector<ContactForce>> measured_forces;  // of the same, with contact
    std::deque<std::vector<HoldingForce>> measured_holds;
    std::uint32_t reported_losses = 0;
    bool lost_proximities = false;  // and reported

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    /// Its OpenGL objects are deleted in its own context.
    ~Impl();

    std::unique_ptr<Solver> make_solver(const Scene& of, const std::shared_ptr<const Model>& from) const;
    /// Makes what a run changes. @pre all that it is made of is there
    void begin();

    /// Keeps the state of OpenGL of an application whose context this uses, while the result lives. Null
    /// where nothing has to be kept.
    std::unique_ptr<gl::HostState> keep_host_state() const {
        return options.use_current_context ? std::make_unique<gl::HostState>() : nullptr;
    }
    /// The same for what the solver does: on the CPU it makes no OpenGL call.
    std::unique_ptr<gl::HostState> keep_host_state_of_solver() const {
        return gpu_solver() != nullptr ? keep_host_state() : nullptr;
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
               (model->objects.size() > 1 || scene.collision.self_collision.value_or(false));
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

    void start_apart();
    /// Bodies that never pass through each other have to be apart. @return whether any was moved
    /// @throws InvalidInput if they cannot be moved apart
    bool move_bodies_apart(std::vector<glm::vec4>& positions, const char* when) const;

    const ModelObject& body(std::size_t object) const;
    void rebuild(const Scene& of, std::shared_ptr<const Model> from, std::vector<AddedPin> added);
    void carry_over_to(const Model& next, const std::vector<AddedPin>& added, State& state, Drags& next_drags,
                       HandleClocks& next_clocks) const;
    const StateCopies& copied_state() const;

    Checkpoint checkpoint() const {
        return {now().frame,    now().time,       solver->read_state(),
                drags->drags(), drags->targets(), clocks->delays()};
    }
    Moment moment_of(const Checkpoint& checkpoint) const {
        return {checkpoint.frame, checkpoint.time,
                static_cast<std::uint64_t>(checkpoint.frame) * static_cast<std::uint64_t>(substeps)};
    }

    /// @throws InvalidInput if a recording is played
    void require_no_playback() const {
        if (recording) throw InvalidInput("this simulator plays a recording: nothing in it can be changed");
    }
    /// As of a recorded frame. Measurements of others stay pending.
    void show(std::size_t index);

    // Continues from this state. Pending measurements belong to the old one.
    void take_state(const State& state, const Moment& moment) {
        for (; !measured.empty(); measured.pop_front()) solver->end_measure();
        standstills.restart();
        measured_forces.clear();
        measured_holds.clear();
        solver->write_state(state);
        ++revision;
        go_on_from(moment);
        watch->begin(state, now());
        clocks->set_held_up(find_held_up());
    }

    // The work of a user's pull or drag is unknown, and the watch does not know of handles that are late.
    void move_held_nodes() {
        if (!pulls.empty() || !forces.empty() || drags->is_under_way())
            watch->note_hand(time() + step_size());
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

    void step();

    template <class Work>
    void run_stage(const char* name, const Work& work) {
        const CurrentStage stage(name);
        const TimedStage timed(options.time_stages ? &solver->stage_timer() : nullptr, name);
        work();
    }
};

}  // namespace gelatin
