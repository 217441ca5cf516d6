#include "sim/simulator_impl.h"

#include <fmt/core.h>

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
    if (arms.programmed().empty()) return made;
    Archive archive = Archive::that_writes(made.programmed);
    HandleArms(arms).archive(archive);
    return made;
}

HandleArms Simulator::Impl::arms_of(const Checkpoint& checkpoint, const std::filesystem::path& file) const {
    HandleArms made(model);
    Archive archive = Archive::that_reads(checkpoint.programmed);
    if (!checkpoint.programmed.empty() && !made.archive(archive))
        throw InvalidInput({file.string(), 0, {}, {}, "was made from a scene with other animated colliders"});
    return made;
}

Moment Simulator::Impl::moment_of(const Checkpoint& checkpoint) const {
    return {checkpoint.frame, checkpoint.time,
            static_cast<std::uint64_t>(checkpoint.frame) * static_cast<std::uint64_t>(clock.substeps())};
}

}  // namespace gelatin
