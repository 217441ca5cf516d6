// What programs and hands change between steps.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gelatin/error.h"
#include "model/drive/handle_animation.h"
#include "sim/body_pose.h"
#include "sim/simulation.h"

namespace gelatin {
namespace {

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

void Simulator::set_positions(std::size_t object, std::span<const glm::vec3> positions) {
    Simulation& d = impl_->simulation();
    const ModelObject& body = d.body(object);
    const Range& nodes = body.nodes;
    check_values(body, "positions", positions);
    const auto host = d.keep_host_state_of_solver();
    State state = d.solver->read_state();
    std::vector<glm::vec4> places = state.positions;
    for (std::uint32_t n = 0; n < nodes.count; ++n) {
        glm::vec4& place = places[nodes.first + n];
        if (place.w > 0.0f) place = glm::vec4(positions[n], place.w);
    }
    if (body.is_rigid) {
        const BodyPose before = nearest_pose(*d.model, body, state.positions),
                       pose = nearest_pose(*d.model, body, places);
        put_rigid(*d.model, body, pose, pose.center - before.center, state);
    } else {
        state.positions = std::move(places);
    }
    if (d.scene.has_contact()) d.move_bodies_apart(state.positions, "where they were set");
    d.take_state(state, d.clock.now());
}

void Simulator::set_velocities(std::size_t object, std::span<const glm::vec3> velocities) {
    Simulation& d = impl_->simulation();
    const ModelObject& body = d.body(object);
    const Range& nodes = body.nodes;
    check_values(body, "velocities", velocities);
    const auto host = d.keep_host_state_of_solver();
    State state = d.solver->read_state();
    const std::vector<glm::vec4> before = state.velocities;
    const bool has_earlier = !state.earlier_velocities.empty();
    for (std::uint32_t n = 0; n < nodes.count; ++n) {
        const std::uint32_t node = nodes.first + n;
        if (state.positions[node].w == 0.0f) continue;
        state.velocities[node] = glm::vec4(velocities[n], state.velocities[node].w);
    }
    if (body.is_rigid) move_rigidly(body, state);
    // Solvers take the change since the step before for what gravity and forces have done.
    for (std::uint32_t n = nodes.first; n < nodes.end() && has_earlier; ++n)
        state.earlier_velocities[n] += glm::vec4(glm::vec3(state.velocities[n] - before[n]), 0.0f);
    d.take_state(state, d.clock.now());
}

void Simulator::set_forces(std::size_t object, std::span<const glm::vec3> forces) {
    Simulation& d = impl_->simulation();
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
    Simulation& d = impl_->simulation();
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
    Simulation& d = impl_->simulation();
    if (pull >= d.pulls.size())
        throw InvalidInput(fmt::format("there is no pull {}: there are {}, from 0", pull, d.pulls.size()));
    const auto host = d.keep_host_state_of_solver();
    d.pulls[pull].target = target;
    d.solver->move_pull(pull, target);
}

void Simulator::set_collider_vertices(const std::string& collider, const std::vector<glm::dvec3>& vertices) {
    Simulation& d = impl_->simulation();
    const std::vector<Handle>& handles = d.model->handles;
    const auto found = std::find_if(handles.begin(), handles.end(), [&](const Handle& handle) {
        return !d.model->is_body(handle.object) && d.model->objects[handle.object].name == collider &&
               handle.animation && !handle.animation->motion;
    });
    if (found == handles.end())
        throw InvalidInput(fmt::format("there is no collider '{}' that a program moves", collider));
    if (vertices.size() != found->animation->vertex_count)
        throw InvalidInput(fmt::format("collider '{}': {} vertices: its shape has {}", collider,
                                       vertices.size(), found->animation->vertex_count));
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const glm::dvec3& p = vertices[v];
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
        throw InvalidInput(fmt::format("collider '{}': vertices[{}] = [{}, {}, {}]: must be finite", collider,
                                       v, p.x, p.y, p.z));
    }
    const auto handle = static_cast<std::size_t>(found - handles.begin());
    const double now = d.time_of(handle);
    d.arms.move(handle, vertices, now, now + d.scene.simulation.frame_time());
}

void Simulator::drag(std::size_t held, const Drag& target) {
    impl_->simulation().drags.set_target(held, target);
}

}  // namespace gelatin
