#include "sim/forces.h"

#include <variant>

namespace gelatin {

// Planes, and surfaces, are in the order of the scene.
std::vector<ContactForce> contact_forces(const Scene& scene, const Model& model, const ContactForces& found) {
    std::vector<std::size_t> planes, surfaces;
    for (std::size_t c = 0; c < scene.colliders.size(); ++c) {
        const bool is_plane = std::holds_alternative<PlaneCollider>(scene.colliders[c].shape);
        (is_plane ? planes : surfaces).push_back(c);
    }
    std::vector<ContactForce> forces;
    for (const ContactForces::Between& between : found.between) {
        ContactForce force;
        force.object = between.object;
        if (between.is_plane) {
            force.collider = planes[between.other];
        } else if (model.is_body(between.other)) {
            force.other = between.other;
        } else {
            force.collider = surfaces[between.other - model.body_count()];
        }
        for (int k = 0; k < 3; ++k) {
            force.normal[k] = between.normal[k];
            force.friction[k] = between.friction[k];
        }
        force.points = between.points;
        forces.push_back(force);
    }
    return forces;
}

std::size_t count_collider_contacts(const Model& model, const ContactForces& found) {
    std::size_t count = 0;
    for (const ContactForces::Between& between : found.between)
        if (between.is_plane || !model.is_body(between.other)) count += between.points;
    return count;
}

std::vector<HoldingForce> holding_forces(const Model& model, Solver& solver) {
    const HoldingForces sums = solver.holding_forces();
    std::vector<HoldingForce> forces;
    for (std::size_t h = 0; h < sums.by_handle.size(); ++h) {
        const Handle& handle = model.handles[h];
        if (!model.is_body(handle.object)) break;  // colliders come last
        HoldingForce force{handle.object, handle.is_pin, handle.index, {}, {}};
        for (int k = 0; k < 3; ++k) {
            force.force[k] = sums.by_handle[h][k];
            force.torque[k] = sums.torques[h][k];
        }
        forces.push_back(force);
    }
    return forces;
}

}  // namespace gelatin
