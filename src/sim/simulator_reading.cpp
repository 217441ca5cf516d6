// What programs read of a simulator's model and its present state.
#include <utility>

#include "gelatin/error.h"
#include "model/region.h"
#include "model/scene/names.h"
#include "model/scene/validate_bodies.h"
#include "sim/body_pose.h"
#include "sim/forces.h"
#include "sim/simulator_impl.h"

#include <fmt/core.h>

namespace gelatin {
namespace {

IndexRange public_range(const Range& range) {
    return {range.first, range.count};
}

}  // namespace

Counts Simulator::counts() const {
    const Model& m = *impl_->model;
    return {m.body_count(), m.positions.size(), m.springs.size(), m.faces.size(), m.tets.size()};
}

std::vector<std::uint32_t> Simulator::nodes_in(std::size_t object, const Region& region) const {
    check_region(region);
    const Range& nodes = impl_->body(object).nodes;
    const std::span<const glm::vec4> own = positions().subspan(nodes.first, nodes.count);
    return find_inside(region, {own.begin(), own.end()});
}

std::size_t Simulator::object_index(std::string_view name) const {
    std::vector<std::string> names;
    for (const ModelObject& body : impl_->model->bodies()) {
        if (body.name == name) return names.size();
        names.push_back(body.name);
    }
    throw InvalidInput(fmt::format("there is no object '{}'{}; there are {}", name, suggestion(name, names),
                                   join_names(names)));
}

ObjectInfo Simulator::object(std::size_t object) const {
    const ModelObject& body = impl_->body(object);
    return {body.name,
            public_range(body.nodes),
            public_range(body.faces),
            public_range(body.tets),
            body.mass,
            body.rest_volume,
            body.is_rigid};
}

glm::dquat Simulator::rotation(std::size_t object) const {
    return nearest_pose(*impl_->model, impl_->body(object), positions()).rotation;
}

std::span<const glm::uvec3> Simulator::faces() const {
    std::vector<glm::uvec3>& faces = impl_->copies.faces;
    if (faces.empty())
        for (const Face& face : impl_->model->faces) faces.emplace_back(face.a, face.b, face.c);
    return faces;
}

std::span<const glm::uvec4> Simulator::tets() const {
    return impl_->model->tets;
}

std::span<const glm::vec4> Simulator::positions() const {
    const std::span<const glm::vec4> own = impl_->solver->host_nodes().positions;
    return own.empty() ? std::span<const glm::vec4>(impl_->copied_state().positions) : own;
}

std::span<const glm::vec4> Simulator::velocities() const {
    const std::span<const glm::vec4> own = impl_->solver->host_nodes().velocities;
    return own.empty() ? std::span<const glm::vec4>(impl_->copied_state().velocities) : own;
}

std::span<const glm::vec4> Simulator::node_contact_forces() const {
    const Impl& d = *impl_;
    std::vector<glm::vec4>& forces = d.copies.contact_forces;
    if (d.copies.forces_revision == d.revision) return forces;
    forces.assign(d.model->node_count(), glm::vec4(0.0f));
    if (d.has_contact_forces()) {
        const ContactForces found = d.solver->contact_forces();
        for (std::size_t n = 0; n < found.normal.size(); ++n)
            forces[n] = glm::vec4(glm::vec3(found.normal[n] + found.friction[n]), 0.0f);
    }
    d.copies.forces_revision = d.revision;
    return forces;
}

std::vector<ContactForce> Simulator::contact_forces() const {
    const Impl& d = *impl_;
    if (!d.has_contact_forces()) return {};
    return gelatin::contact_forces(d.scene, *d.model, d.solver->contact_forces());
}

std::vector<HeldNodes> Simulator::held_nodes() const {
    const Impl& d = *impl_;
    std::vector<HeldNodes> all;
    for (std::size_t h = 0; h < d.model->handles.size(); ++h) {
        const Handle& handle = d.model->handles[h];
        if (!d.model->is_body(handle.object)) break;  // colliders come last
        const HandlePose pose = d.pose_of(h);
        const bool is_released = !is_held(handle, d.time_of(h), step_size());
        all.push_back({handle.object, handle.is_pin, handle.index, handle.count, is_released,
                       pose.place(d.arms.middle(h, d.time_of(h))), pose.center, d.drags.drags()[h],
                       d.drags.targets()[h]});
    }
    return all;
}

HostFrame Simulator::read_frame() const {
    const auto kept = impl_->keep_host_state_of_solver();
    const State state = impl_->solver->read_state();
    HostFrame host;
    host.frame = frame();
    host.time = time();
    for (const glm::vec4& p : state.positions) host.positions.insert(host.positions.end(), {p.x, p.y, p.z});
    for (const glm::vec4& v : state.velocities)
        host.velocities.insert(host.velocities.end(), {v.x, v.y, v.z});
    for (const glm::dvec3& force : impl_->solver->holding_forces().nodes)
        for (int k = 0; k < 3; ++k) host.holding_forces.push_back(static_cast<float>(force[k]));
    if (!impl_->has_contact_forces()) return host;
    const ContactForces forces = impl_->solver->contact_forces();
    for (std::size_t n = 0; n < forces.normal.size(); ++n) {
        const glm::vec3 friction(forces.friction[n]), force(forces.normal[n] + forces.friction[n]);
        host.contact_forces.insert(host.contact_forces.end(), {force.x, force.y, force.z});
        host.contact_friction.insert(host.contact_friction.end(), {friction.x, friction.y, friction.z});
    }
    return host;
}

}  // namespace gelatin
