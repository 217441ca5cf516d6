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

LimitedSweeps::LimitedSweeps(const Model& model, const ModelBuffers& buffers)
    : buffers_(buffers),
      program_(gl::Program::compute("sim/descent/descend.comp", sweep_defines(model))),
      objective_(model),
      contacts_(model),
      nodes_(model.positions, model.velocities),
      limits_(model.surface_parts.nodes.size()),
      planes_(1),
      shares_(1) {
    objective_.bind(program_);
    contacts_.bind(program_);
    program_.bind("positions", nodes_.position_texels);
    program_.bind("start_velocities", nodes_.velocity_texels);
    program_.bind("OutPositions", nodes_.positions);
    program_.bind("Limits", limits_);
}

void LimitedSweeps::begin(double step, std::span<const glm::vec4> starts,
                          std::span<const glm::vec4> targets) {
    objective_.starts.upload(starts);
    objective_.targets.upload(targets);
    objective_.near_flat.fill(0);
    contacts_.objects.fill(0);
    contacts_.nodes.upload(std::vector<ColliderContact>(contacts_.nodes.size()));
    objective_.begin(nodes_, nodes_, step);
    program_.set("time_step", static_cast<float>(step));
    buffers_.bind_colliders(program_);
}

void LimitedSweeps::start(int sweeps, bool updates_tets, const ContactLimits& limits,
                          std::span<const glm::vec4> positions) {
    nodes_.positions.upload(positions);
    limits_.upload(limits.nodes);
    upload(limits.planes, planes_);
    upload(limits.shares, shares_);
    program_.bind("Planes", planes_);
    program_.bind("Shares", shares_);
    if (updates_tets) objective_.update(std::array{&std::as_const(program_)});
    for (int i = 0; i < sweeps; ++i) {
        for (const Range& rows : objective_.colors()) {
            program_.set("first_row", rows.first);
            program_.set("row_count", rows.count);
            program_.dispatch(rows.count);
            gl::barrier(gl::Barrier::texture_fetch | gl::Barrier::storage);
        }
    }
    gl::barrier(gl::Barrier::buffer_update);
}

void LimitedSweeps::finish(std::span<glm::vec4> positions, DeviceContacts& contacts) {
    nodes_.positions.download(positions);
    contacts.nodes.resize(contacts_.nodes.size());
    contacts.objects.resize(contacts_.objects.size());
    contacts_.nodes.download(contacts.nodes);
    contacts_.objects.download(contacts.objects);
}

}  // namespace gelatin::gpu
