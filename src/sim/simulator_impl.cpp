#include "sim/simulator_impl.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "sim/own_handles.h"

namespace gelatin {
namespace {

// A motor that a program has set, or one of its keyframes, which follow it. What is not given is NaN.
struct MotorRow {
    std::uint64_t attachment;
    double time, speed, position, force;
};

std::vector<MotorRow> rows_of(const std::map<std::size_t, JointMotor>& motors) {
    std::vector<MotorRow> rows;
    for (const auto& [attachment, motor] : motors) {
        const auto add = [&, a = attachment](double time, const auto& of) {
            const double none = std::nan("");
            rows.push_back(
                {a, time, of.speed.value_or(none), of.position.value_or(none), of.force.value_or(none)});
        };
        add(0.0, motor);
        for (const MotorKeyframe& keyframe : motor.keyframes) add(keyframe.time, keyframe);
    }
    return rows;
}

std::map<std::size_t, JointMotor> motors_of(const std::vector<MotorRow>& rows) {
    std::map<std::size_t, JointMotor> motors;
    const auto given = [](double value) { return std::isnan(value) ? std::nullopt : std::optional(value); };
    for (const MotorRow& row : rows) {
        const auto [motor, is_new] = motors.try_emplace(row.attachment);
        const auto set = [&](auto& of) {
            of.speed = given(row.speed);
            of.position = given(row.position);
            of.force = given(row.force);
        };
        is_new ? set(motor->second) : set(motor->second.keyframes.emplace_back(MotorKeyframe{row.time}));
    }
    return motors;
}

}  // namespace

Simulator::Impl::Impl(const Scene& of, std::shared_ptr<const Model> from, const SimulatorOptions& with,
                      int substeps)
    : scene(of),
      options(with),
      model(std::move(from)),
      clock(of.simulation.frame_time(), substeps),
      drags(model),
      handle_clocks(model),
      arms(model) {
    scene.collision.response = of.collision.response_with(of.simulation.solver);
    watch.emplace(scene, model, substeps);
}

Simulator::Impl::~Impl() {
    if (!context) return;
    try {
        context->make_current();
    } catch (const GlError& error) {
        log_debug(error.what());  // current on another thread: the driver keeps what it has until the end
    }
}

const ModelObject& Simulator::Impl::body(std::size_t object) const {
    if (object < model->body_count()) return model->objects[object];
    throw InvalidInput(
        fmt::format("there is no object {}: there are {}, from 0", object, model->body_count()));
}

double Simulator::Impl::time_of(std::size_t handle) const {
    return clock.time() - handle_clocks.delays()[handle];
}

HandlePose Simulator::Impl::pose_of(std::size_t handle) const {
    return pose_at(model->handles[handle], time_of(handle), drags.drags()[handle]);
}

const StateCopies& Simulator::Impl::copied_state() const {
    if (copies.nodes_revision == revision) return copies;
    const auto host = keep_host_state_of_solver();
    State state = solver->read_state();
    copies.positions = std::move(state.positions);
    copies.velocities = std::move(state.velocities);
    copies.nodes_revision = revision;
    return copies;
}

Checkpoint Simulator::Impl::checkpoint() const {
    const Moment now = clock.now();
    Checkpoint made{now.frame,
                    now.time,
                    solver->read_state(),
                    of_own_handles(*model, drags.drags()),
                    of_own_handles(*model, drags.targets()),
                    of_own_handles(*model, handle_clocks.delays()),
                    set_cavity_drives()};
    const std::string attached = attachments_memory();
    if (arms.programmed().empty() && motors.empty() && attached.empty()) return made;
    Archive archive = Archive::that_writes(made.programmed);
    HandleArms(arms).archive(archive);
    std::vector<MotorRow> rows = rows_of(motors);
    archive.list(rows);
    std::vector<char> bytes(attached.begin(), attached.end());
    archive.list(bytes);
    return made;
}

Simulator::Impl::Programmed Simulator::Impl::programmed_of(const Checkpoint& checkpoint,
                                                           const std::filesystem::path& file) const {
    Programmed made{HandleArms(model), {}, {}};
    if (checkpoint.programmed.empty()) return made;
    const auto refuse = [&](const char* others) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, fmt::format("was made from a scene with other {}", others)});
    };
    Archive archive = Archive::that_reads(checkpoint.programmed);
    if (!made.arms.archive(archive)) refuse("animated colliders");
    if (archive.is_complete()) return made;  // by an earlier version
    std::vector<MotorRow> rows;
    std::vector<char> attached;
    archive.list(rows);
    if (!archive.is_complete()) archive.list(attached);
    if (!archive.is_complete()) refuse("attachments");
    made.motors = motors_of(rows);
    made.attachments.assign(attached.begin(), attached.end());
    return made;
}

Moment Simulator::Impl::moment_of(const Checkpoint& checkpoint) const {
    return {checkpoint.frame, checkpoint.time,
            static_cast<std::uint64_t>(checkpoint.frame) * static_cast<std::uint64_t>(clock.substeps())};
}

}  // namespace gelatin
