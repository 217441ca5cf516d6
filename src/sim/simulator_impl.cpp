#include "sim/simulator_impl.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"
#include "model/scene/validate_cavities.h"
#include "sim/own_handles.h"

namespace gelatin {
namespace {

// A motor that a program has set, or one of its keyframes, which follow it. What is not given is NaN.
struct MotorRow {
    std::uint64_t attachment;
    double time, speed, position, force;
};

// What a program has given a cavity.
struct GasRow {
    std::uint64_t cavity;
    double pressure, amount;
};

// As in a scene with another law it is not.
bool is_allowed(const CavityGas& gas, const CavityDescription& cavity) {
    bool is_allowed = true;
    const ReportProblem refuse = [&](const auto&...) { is_allowed = false; };
    check_gas(ValueChecks(refuse), {}, cavity, gas);
    return is_allowed;
}

double value_or_nan(const std::optional<double>& value) {
    return value.value_or(std::nan(""));
}
std::optional<double> given(double value) {
    return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::vector<MotorRow> rows_of(const std::map<std::size_t, JointMotor>& motors) {
    std::vector<MotorRow> rows;
    for (const auto& [attachment, motor] : motors) {
        const auto add = [&, a = attachment](double time, const auto& of) {
            rows.push_back(
                {a, time, value_or_nan(of.speed), value_or_nan(of.position), value_or_nan(of.force)});
        };
        add(0.0, motor);
        for (const MotorKeyframe& keyframe : motor.keyframes) add(keyframe.time, keyframe);
    }
    return rows;
}

std::map<std::size_t, JointMotor> motors_of(const std::vector<MotorRow>& rows) {
    std::map<std::size_t, JointMotor> motors;
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
                    of_own_handles(*model, handle_clocks.delays())};
    const std::string attached = attachments_memory();
    if (arms.programmed().empty() && motors.empty() && attached.empty() && cavity_gas.empty()) return made;
    Archive archive = Archive::that_writes(made.programmed);
    HandleArms(arms).archive(archive);
    std::vector<MotorRow> rows = rows_of(motors);
    archive.list(rows);
    std::vector<char> bytes(attached.begin(), attached.end());
    archive.list(bytes);
    std::vector<GasRow> gas;
    for (const auto& [cavity, of] : cavity_gas)
        gas.push_back({cavity, value_or_nan(of.pressure), value_or_nan(of.amount)});
    archive.list(gas);
    return made;
}

Simulator::Impl::Programmed Simulator::Impl::programmed_of(const Checkpoint& checkpoint,
                                                           const std::filesystem::path& file) const {
    Programmed made{HandleArms(model), {}, {}, {}};
    if (checkpoint.programmed.empty()) return made;
    const auto refuse = [&](const char* others) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, fmt::format("was made from a scene with other {}", others)});
    };
    Archive archive = Archive::that_reads(checkpoint.programmed);
    if (!made.arms.archive(archive)) refuse("animated colliders");
    std::vector<MotorRow> rows;
    std::vector<char> attached;
    std::vector<GasRow> gas;
    archive.list(rows);
    archive.list(attached);
    archive.list(gas);
    if (!archive.is_complete()) refuse("attachments");
    made.motors = motors_of(rows);
    made.attachments.assign(attached.begin(), attached.end());
    for (const GasRow& row : gas) {
        const CavityGas of{given(row.pressure), given(row.amount)};
        if (row.cavity >= model->cavities.size() || !is_allowed(of, model->cavities[row.cavity].gas))
            refuse("cavities");
        made.cavity_gas[row.cavity] = of;
    }
    return made;
}

Moment Simulator::Impl::moment_of(const Checkpoint& checkpoint) const {
    return {checkpoint.frame, checkpoint.time,
            static_cast<std::uint64_t>(checkpoint.frame) * static_cast<std::uint64_t>(clock.substeps())};
}

}  // namespace gelatin
