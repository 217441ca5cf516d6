#include "gpu/descent/limited_sweeps.h"

#include <array>
#include <utility>
#include <vector>

namespace gelatin::gpu {
namespace {

gl::Defines sweep_defines(const Model& model) {
    gl::Defines defines = StepObjective::defines(model);
    defines.emplace_back("CONTACT");
    return defines;
}

// Makes the buffer larger where it is too small.
template <class T>
void upload(const std::vector<T>& values, gl::Buffer<T>& buffer) {
    if (buffer.size() < values.size()) buffer = gl::Buffer<T>(values.size() + values.size() / 2);
    buffer.upload(values);
}

}  // namespace

LimitedSweeps::LimitedSweeps(const Model& model, const ModelBuffers& buffers, const DescentSettings& settings)
    : buffers_(buffers),
      program_(gl::Program::compute("sim/descent/descend.comp", sweep_defines(model))),
      moves_(model, settings.coarse_level),
      starts_(model.positions, model.velocities),
      nodes_(model.positions, model.velocities),
      limits_(model.surface_parts.nodes.size()),
      planes_(1),
      shares_(1) {
    moves_.objective.bind(program_);
    moves_.contacts.bind(program_);
    program_.bind("positions", nodes_.position_texels);
    program_.bind("start_velocities", starts_.velocity_texels);
    program_.bind("OutPositions", nodes_.positions);
    program_.bind("Limits", limits_);
}

void LimitedSweeps::begin(double step, std::span<const glm::vec4> starts,
                          std::span<const glm::vec4> targets) {
    moves_.objective.starts.upload(starts);
    moves_.objective.targets.upload(targets);
    moves_.objective.near_flat.fill(0);
    moves_.contacts.objects.fill(0);
    moves_.contacts.nodes.upload(std::vector<ColliderContact>(moves_.contacts.nodes.size()));
    moves_.objective.begin(starts_, nodes_, step);
    step_ = step;
    program_.set("time_step", static_cast<float>(step));
    buffers_.bind_colliders(program_);
}

void LimitedSweeps::start(int sweeps, TetUpdate update, const ContactLimits& limits,
                          std::span<const glm::vec4> positions) {
    nodes_.positions.upload(positions);
    limits_.upload(limits.nodes);
    upload(limits.planes, planes_);
    upload(limits.shares, shares_);
    program_.bind("Planes", planes_);
    program_.bind("Shares", shares_);
    moves_.objective.update(update, std::array{&std::as_const(program_)});
    for (int i = 0; i < sweeps; ++i) {
        for (const Range& rows : moves_.objective.colors()) {
            program_.set("first_row", rows.first);
            program_.set("row_count", rows.count);
            program_.dispatch(rows.count);
            gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
        }
    }
    gl::barrier(gl::Barrier::buffer_update);
}

void LimitedSweeps::start_apart(int sweeps, std::span<const glm::vec4> positions) {
    nodes_.positions.upload(positions);
    moves_.begin(buffers_, starts_, nodes_, step_);
    moves_.run(sweeps, nodes_);
    gl::barrier(gl::Barrier::buffer_update);
}

void LimitedSweeps::finish(std::span<glm::vec4> positions, DeviceContacts& contacts) {
    nodes_.positions.download(positions);
    contacts.nodes.resize(moves_.contacts.nodes.size());
    contacts.objects.resize(moves_.contacts.objects.size());
    moves_.contacts.nodes.download(contacts.nodes);
    moves_.contacts.objects.download(contacts.objects);
}

}  // namespace gelatin::gpu
