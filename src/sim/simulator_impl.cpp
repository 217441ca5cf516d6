#include "sim/simulator_impl.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "core/log.h"
#include "gelatin/error.h"

namespace gelatin {

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

namespace {

// Motors by attachment. What is not given is NaN.
void archive_motors(Archive& archive, std::map<std::size_t, JointMotor>& motors) {
    using Row = std::array<double, 4>;  // time, speed, position, force
    const auto row = [](double time, const auto& of) {
        const double none = std::nan("");
        return Row{time, of.speed.value_or(none), of.position.value_or(none), of.force.value_or(none)};
    };
    const auto set = [](const Row& values, auto& of) {
        const auto given = [](double value) {
            return std::isnan(value) ? std::nullopt : std::optional(value);
        };
        of.speed = given(values[1]);
        of.position = given(values[2]);
        of.force = given(values[3]);
    };
    const auto written = std::exchange(motors, {});
    auto next = written.begin();
    std::size_t count = written.size();
    archive.value(count);
    for (; count > 0 && !archive.has_failed(); --count) {
        std::size_t attachment = 0;
        std::vector<Row> rows;
        if (next != written.end()) {
            attachment = next->first;
            rows.push_back(row(0.0, next->second));
            for (const MotorKeyframe& keyframe : next->second.keyframes)
                rows.push_back(row(keyframe.time, keyframe));
            ++next;
        }
        archive.value(attachment);
        archive.list(rows);
        if (rows.empty()) return archive.fail();
        JointMotor& motor = motors[attachment];
        set(rows[0], motor);
        for (std::size_t k = 1; k < rows.size(); ++k)
            set(rows[k], motor.keyframes.emplace_back(MotorKeyframe{rows[k][0]}));
    }
}

}  // namespace

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
    Checkpoint made{now.frame,          now.time,        solver->read_state(),
                    drags.drags(),      drags.targets(), handle_clocks.delays(),
                    set_cavity_drives()};
    if (arms.programmed().empty() && motors.empty()) return made;
    Archive archive = Archive::that_writes(made.programmed);
    HandleArms(arms).archive(archive);
    std::map<std::size_t, JointMotor> set = motors;
    if (!set.empty()) archive_motors(archive, set);
    return made;
}

Simulator::Impl::Programmed Simulator::Impl::programmed_of(const Checkpoint& checkpoint,
                                                           const std::filesystem::path& file) const {
    Programmed made{HandleArms(model), {}};
    if (checkpoint.programmed.empty()) return made;
    const auto refuse = [&](const char* others) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, fmt::format("was made from a scene with other {}", others)});
    };
    Archive archive = Archive::that_reads(checkpoint.programmed);
    if (!made.arms.archive(archive)) refuse("animated colliders");
    if (archive.is_complete()) return made;
    archive_motors(archive, made.motors);
    if (!archive.is_complete()) refuse("attachments");
    // Those of attachments that were made while it ran, which are not there.
    made.motors.erase(made.motors.lower_bound(scene.attachments.size()), made.motors.end());
    return made;
}

Moment Simulator::Impl::moment_of(const Checkpoint& checkpoint) const {
    return {checkpoint.frame, checkpoint.time,
            static_cast<std::uint64_t>(checkpoint.frame) * static_cast<std::uint64_t>(clock.substeps())};
}

}  // namespace gelatin
