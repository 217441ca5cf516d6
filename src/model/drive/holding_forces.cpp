#include "model/drive/holding_forces.h"

#include <glm/geometric.hpp>

namespace gelatin {
namespace {

// Calls work(index in Model::handle_nodes, node, handle) for what holds nodes of bodies at present.
template <class Real, class Work>
void for_each_held(const Model& model, std::span<const glm::vec<4, Real>> positions, const Work& work) {
    for (std::size_t h = 0; h < model.handle_nodes.size(); ++h) {
        const HandleNode& held = model.handle_nodes[h];
        const bool is_released = positions[held.node].w != Real(0);
        if (!is_released && model.is_body(model.handles[held.handle].object)) work(h, held.node, held.handle);
    }
}

}  // namespace

template <class Real>
HoldingForces find_holding_forces(const Model& model, std::span<const glm::vec<4, Real>> positions,
                                  std::span<const glm::dvec3> others,
                                  std::span<const glm::dvec3> accelerations) {
    const std::vector<glm::dvec3> none(model.handles.size(), glm::dvec3(0.0));
    HoldingForces forces{none, none, std::vector<glm::dvec3>(model.node_count(), glm::dvec3(0.0))};
    if (others.empty()) return forces;
    std::vector<glm::dvec3> centers = none;
    const glm::dvec3 gravity(model.gravity);
    for_each_held(model, positions, [&](std::size_t h, std::uint32_t n, std::uint32_t handle) {
        const auto mass = static_cast<double>(model.masses[n]);
        forces.nodes[n] = -mass * gravity - others[n];
        if (!accelerations.empty()) forces.nodes[n] += mass * accelerations[h];
        forces.by_handle[handle] += forces.nodes[n];
        centers[handle] += glm::dvec3(positions[n]) / static_cast<double>(model.handles[handle].count);
    });
    for_each_held(model, positions, [&](std::size_t, std::uint32_t n, std::uint32_t handle) {
        forces.torques[handle] += glm::cross(glm::dvec3(positions[n]) - centers[handle], forces.nodes[n]);
    });
    return forces;
}

template HoldingForces find_holding_forces<float>(const Model&, std::span<const glm::vec4>,
                                                  std::span<const glm::dvec3>, std::span<const glm::dvec3>);
template HoldingForces find_holding_forces<double>(const Model&, std::span<const glm::dvec4>,
                                                   std::span<const glm::dvec3>, std::span<const glm::dvec3>);

}  // namespace gelatin
