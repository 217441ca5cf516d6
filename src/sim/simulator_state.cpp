// What programs read of the state between steps, and what they change of it.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gelatin/error.h"
#include "model/scene/names.h"
#include "sim/check_starts.h"
#include "sim/forces.h"
#include "sim/move_apart.h"
#include "sim/simulator_impl.h"

namespace gelatin {
namespace {

IndexRange public_range(const Range& range) {
    return {range.first, range.count};
}

void check_values(const ModelObject& body, const char* what, std::span<const glm::vec3> values) {
    const std::string name = fmt::format("{} of object '{}'", what, body.name);
    if (values.size() != body.nodes.count) {
        throw InvalidInput({{},
                            0,
                            name,
                            {},
                            fmt::format("are {}, and must be {}, one for each of its nodes", values.size(),
                                        body.nodes.count)});
    }
    for (std::size_t n = 0; n < values.size(); ++n) {
        const glm::vec3& v = values[n];
        if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) continue;
        throw InvalidInput({{},
                            0,
                            name,
                            fmt::format("[{}, {}, {}]", v.x, v.y, v.z),
                            fmt::format("must be finite, at node {}", n)});
    }
}

}  // namespace

const ModelObject& Simulator::Impl::body(std::size_t object) const {
    if (object < model->body_count()) return model->objects[object];
    throw InvalidInput(
        fmt::format("there is no object {}: there are {}, from 0", object, model->body_count()));
}

void Simulator::Impl::start_apart() {
    State state = first_state();
    if (move_bodies_apart(state.positions, "at the start")) start_state = std::move(state);
}

bool Simulator::Impl::move_bodies_apart(std::vector<glm::vec4>& positions, const char* when) const {
    std::optional<MovedApart> moved = move_apart(model, positions, when);
    if (moved) {
        require_apart(model, scene, moved->positions, when);  // both may be held
        for (const std::string& line : moved->lines) log_warning(line);
        positions = std::move(moved->positions);
    }
    if (scene.collision.self_collision_with(scene.simulation.solver))
        for (const std::string& line : find_tangled(model, positions, when)) log_warning(line);
    return moved.has_value();
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
    return {body.name, public_range(body.nodes), public_range(body.faces), public_range(body.tets),
            body.mass, body.rest_volume};
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
    const std::span<const glm::vec4> own = impl_->solver->host_positions();
    return own.empty() ? std::span<const glm::vec4>(impl_->copied_state().positions) : own;
}

std::span<const glm::vec4> Simulator::velocities() const {
    const std::span<const glm::vec4> own = impl_->solver->host_velocities();
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
    return gelatin::contact_forces(d.scene, *d.model, *d.solver);
}

void Simulator::set_positions(std::size_t object, std::span<const glm::vec3> positions) {
    impl_->require_no_playback();
    Impl& d = *impl_;
    const Range& nodes = d.body(object).nodes;
    check_values(d.body(object), "positions", positions);
    const auto host = d.keep_host_state_of_solver();
    State state = d.solver->read_state();
    for (std::uint32_t n = 0; n < nodes.count; ++n) {
        glm::vec4& place = state.positions[nodes.first + n];
        if (place.w > 0.0f) place = glm::vec4(positions[n], place.w);
    }
    if (d.scene.has_contact()) d.move_bodies_apart(state.positions, "where they were set");
    d.take_state(state, d.now());
}

void Simulator::set_velocities(std::size_t object, std::span<const glm::vec3> velocities) {
    impl_->require_no_playback();
    Impl& d = *impl_;
    const Range& nodes = d.body(object).nodes;
    check_values(d.body(object), "velocities", velocities);
    const auto host = d.keep_host_state_of_solver();
    State state = d.solver->read_state();
    const bool has_earlier = !state.earlier_velocities.empty();
    for (std::uint32_t n = 0; n < nodes.count; ++n) {
        const std::uint32_t node = nodes.first + n;
        if (state.positions[node].w == 0.0f) continue;
        state.velocities[node] = glm::vec4(velocities[n], state.velocities[node].w);
        // Solvers take the change since the step before for what gravity has done.
        if (has_earlier) state.earlier_velocities[node] = state.velocities[node];
    }
    d.take_state(state, d.now());
}

void Simulator::set_forces(std::size_t object, std::span<const glm::vec3> forces) {
    impl_->require_no_playback();
    Impl& d = *impl_;
    const Range& nodes = d.body(object).nodes;
    if (!forces.empty()) check_values(d.body(object), "forces", forces);
    std::vector<glm::vec3> all = d.forces;
    all.resize(d.model->node_count(), glm::vec3(0.0f));
    for (std::uint32_t n = 0; n < nodes.count; ++n)
        all[nodes.first + n] = forces.empty() ? glm::vec3(0.0f) : forces[n];
    const bool any =
        std::any_of(all.begin(), all.end(), [](const glm::vec3& f) { return f != glm::vec3(0.0f); });
    const auto host = d.keep_host_state_of_solver();
    d.forces = any ? std::move(all) : std::vector<glm::vec3>();
    d.solver->set_forces(d.forces);
}

void Simulator::set_pulls(std::vector<Pull> pulls) {
    impl_->require_no_playback();
    Impl& d = *impl_;
    for (std::size_t p = 0; p < pulls.size(); ++p) {
        std::vector<std::uint32_t> nodes;
        for (const Pull::Node& held : pulls[p].nodes) {
            if (held.node >= d.model->body_node_count()) {
                throw InvalidInput(fmt::format("pull {}: there is no node {}: bodies have {}, from 0", p,
                                               held.node, d.model->body_node_count()));
            }
            if (!(held.stiffness > 0.0f) || !std::isfinite(held.stiffness)) {
                throw InvalidInput(fmt::format("pull {}: stiffness = {} at node {}: must be positive", p,
                                               held.stiffness, held.node));
            }
            nodes.push_back(held.node);
        }
        std::sort(nodes.begin(), nodes.end());
        if (const auto twice = std::adjacent_find(nodes.begin(), nodes.end()); twice != nodes.end())
            throw InvalidInput(fmt::format("pull {}: node {} is there twice", p, *twice));
    }
    const auto host = d.keep_host_state_of_solver();
    d.pulls = std::move(pulls);
    d.solver->set_pulls(d.pulls);
}

void Simulator::move_pull(std::size_t pull, const glm::dvec3& target) {
    impl_->require_no_playback();
    Impl& d = *impl_;
    if (pull >= d.pulls.size())
        throw InvalidInput(fmt::format("there is no pull {}: there are {}, from 0", pull, d.pulls.size()));
    const auto host = d.keep_host_state_of_solver();
    d.pulls[pull].target = target;
    d.solver->move_pull(pull, target);
}

}  // namespace gelatin
