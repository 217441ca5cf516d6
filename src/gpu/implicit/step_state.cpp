#include "gpu/implicit/step_state.h"

#include <algorithm>
#include <limits>

#include "model/shared_constants.h"

namespace gelatin::gpu {
namespace {

constexpr RestState kRestless{0.0f, 0, 1, 0};

// Of colliders, which have no thickness, as of the thinnest body.
std::vector<float> rest_distances_of(const Model& model, const ContactSurface& surface) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t o = 0; o < model.body_count(); ++o) least = std::min(least, surface.thicknesses[o]);
    std::vector<float> distances(model.node_count());
    for (std::size_t o = 0; o < model.objects.size(); ++o)
        std::fill_n(distances.begin() + model.objects[o].nodes.first, model.objects[o].nodes.count,
                    contact_tuning::kSleepPlace *
                        static_cast<float>(model.is_body(o) ? surface.thicknesses[o] : least));
    return distances;
}

}  // namespace

StepState::StepState(const Model& model, const ContactSurface& surface)
    : from(model.positions, model.velocities),
      to(model.positions, model.velocities),
      paces(model.objects.size(), gl::TexelFormat::rgba32f),
      goals(model.positions.size(), gl::TexelFormat::rgba32f),
      held_changes(model.positions.size(), gl::TexelFormat::rgba32f),
      predicted(model.positions.size(), gl::TexelFormat::rgba32f),
      accelerations(model.positions.size(), gl::TexelFormat::rgba32f),
      rest(std::vector<RestState>{kRestless}),
      places(model.positions),
      stiffness_(surface.stiffness, gl::TexelFormat::r32f),
      thicknesses_(std::vector<float>(surface.thicknesses.begin(), surface.thicknesses.end()),
                   gl::TexelFormat::r32f),
      masses_(model.masses, gl::TexelFormat::r32f),
      rest_distances_(rest_distances_of(model, surface), gl::TexelFormat::r32f),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      body_nodes_(model.body_node_count()) {
    const std::size_t planes = std::max<std::size_t>(model.colliders.size() * model.body_node_count(), 1);
    plane_memories = gl::Buffer<PlaneMemory>(std::vector<PlaneMemory>(planes));
    plane_notes = gl::Buffer<PlaneMemory>(std::vector<PlaneMemory>(planes));
}

void StepState::wake() {
    rest.upload(std::vector<RestState>{kRestless});
}

void StepState::bind(const gl::Program& program) const {
    tries.bind(program);
    paces.bind(program, "Paces", "paces");
    goals.bind(program, "Goals", "goals");
    program.bind_declared("HeldChanges", held_changes.values);
    predicted.bind(program, "Predicted", "predicted");
    accelerations.bind(program, "Accelerations", "accelerations");
    program.bind_declared("PlaneMemories", plane_memories);
    program.bind_declared("PlaneNotes", plane_notes);
    program.bind_declared("Rest", rest);
    program.bind_declared("Places", places);
    program.bind_declared("rest_distances", rest_distances_);
    program.bind_declared("node_stiffness", stiffness_);
    program.bind_declared("thicknesses", thicknesses_);
    program.bind_declared("masses", masses_);
    program.set("body_count", body_count_);
    program.set("body_nodes", body_nodes_);
}

}  // namespace gelatin::gpu
