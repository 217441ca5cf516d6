#include "sim/carry_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "model/assembly/attachments.h"
#include "model/drive/handle_animation.h"
#include "sim/body_pose.h"

namespace gelatin {
namespace {

// By a body's own nodes. Their order depends on where they are.
std::vector<std::array<std::uint32_t, 3>> sorted_faces(const Model& model, const ModelObject& object) {
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t f = object.faces.first; f < object.faces.end(); ++f) {
        const Face& face = model.faces[f];
        const std::uint32_t first = object.nodes.first;
        faces.push_back({face.a - first, face.b - first, face.c - first});
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

bool have_the_same_mesh(const Model& a, const ModelObject& in_a, const Model& b, const ModelObject& in_b) {
    if (in_a.is_rigid != in_b.is_rigid || in_a.nodes.count != in_b.nodes.count ||
        in_a.tets.count != in_b.tets.count)
        return false;
    if (in_a.is_rigid) return sorted_faces(a, in_a) == sorted_faces(b, in_b);
    for (std::uint32_t t = 0; t < in_a.tets.count; ++t) {
        if (a.tets[in_a.tets.first + t] - in_a.nodes.first != b.tets[in_b.tets.first + t] - in_b.nodes.first)
            return false;
    }
    return true;
}

// Only xyz; the fourth components are the model's.
void copy_vectors(const std::vector<glm::vec4>& from, const Range& range, std::vector<glm::vec4>& to,
                  std::uint32_t first) {
    for (std::uint32_t n = 0; n < range.count; ++n)
        to[first + n] = glm::vec4(glm::vec3(from[range.first + n]), to[first + n].w);
}

const ModelObject* find_same(const Model& from, const Model& to, const ModelObject& object) {
    const auto bodies = from.bodies();
    const auto same = std::find_if(bodies.begin(), bodies.end(), [&](const ModelObject& other) {
        return other.name == object.name && have_the_same_mesh(from, other, to, object);
    });
    return same == bodies.end() ? nullptr : &*same;
}

// Where another model places a body, or what it weighs, its nodes inside may be elsewhere.
bool has_the_same_nodes(const Model& a, const Range& in_a, const Model& b, const Range& in_b) {
    const auto part = [](const auto& values, const Range& range) {
        return std::span(values).subspan(range.first, range.count);
    };
    return std::ranges::equal(part(a.positions, in_a), part(b.positions, in_b));
}

// The nodes of a handle, in ascending order, by their index in the object.
std::vector<std::uint32_t> nodes_of(const Model& model, std::size_t handle) {
    const ModelObject& object = model.objects[model.handles[handle].object];
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t h = object.handle_nodes.first; h < object.handle_nodes.end(); ++h) {
        const HandleNode& held = model.handle_nodes[h];
        if (held.handle == handle) nodes.push_back(held.node - object.nodes.first);
    }
    return nodes;
}

std::optional<std::size_t> find_handle(const Model& model, const ModelObject& object,
                                       const std::vector<std::uint32_t>& nodes) {
    for (std::size_t h = 0; h < model.handles.size(); ++h) {
        if (&model.objects[model.handles[h].object] == &object && nodes_of(model, h) == nodes) return h;
    }
    return {};
}

// The collider of `from` that has the same name as one of `to`, and moves; null: none.
const ModelObject* find_same_collider(const Model& from, const ModelObject& collider) {
    const auto first = from.objects.begin() + static_cast<std::ptrdiff_t>(from.body_count());
    const auto same = std::find_if(first, from.objects.end(), [&](const ModelObject& other) {
        return other.name == collider.name && other.handle_nodes.count > 0;
    });
    return same == from.objects.end() ? nullptr : &*same;
}

Drag drag_to(const State& state, const Model& model, std::size_t handle, double time) {
    std::vector<glm::dvec3> arms, places;
    for (const HandleNode& held : model.handle_nodes) {
        if (held.handle != handle) continue;
        arms.emplace_back(held.arm);
        places.emplace_back(state.positions[held.node]);
    }
    return nearest_drag(pose_at(model.handles[handle], time), arms, places);
}

}  // namespace

State carried_over(const Model& from, const State& state, const Model& to, State start) {
    const bool has_earlier = !state.earlier_velocities.empty();
    if (has_earlier) start.earlier_velocities = start.velocities;
    for (const ModelObject& object : to.bodies()) {
        const ModelObject* same = find_same(from, to, object);
        if (same == nullptr) continue;
        copy_vectors(state.positions, same->nodes, start.positions, object.nodes.first);
        copy_vectors(state.velocities, same->nodes, start.velocities, object.nodes.first);
        if (has_earlier)
            copy_vectors(state.earlier_velocities, same->nodes, start.earlier_velocities, object.nodes.first);
        if (object.is_rigid && !has_the_same_nodes(from, same->nodes, to, object.nodes))
            put_rigid(to, object, nearest_pose_of_surface(to, object, start.positions), glm::dvec3(0.0),
                      start);
    }
    for (const HandleNode& held : to.handle_nodes) {
        if (std::isinf(to.handles[held.handle].release))
            start.velocities[held.node] = to.velocities[held.node];
    }
    return start;
}

Drags carried_over(const Model& from, const Drags& drags, const Model& to, const State& state,
                   const std::vector<double>& times, Drags start) {
    std::vector<Drag> carried = start.drags(), targets = start.targets();
    for (std::size_t h = 0; h < to.handles.size(); ++h) {
        if (!to.is_body(to.handles[h].object)) continue;
        const ModelObject* same = find_same(from, to, to.objects[to.handles[h].object]);
        if (same == nullptr || to.handles[h].count == 0) continue;
        const std::optional<std::size_t> earlier = find_handle(from, *same, nodes_of(to, h));
        const bool follows = !earlier && to.handles[h].animation != nullptr;  // no drag could say how
        carried[h] = earlier ? drags.drags()[*earlier] : follows ? Drag() : drag_to(state, to, h, times[h]);
        targets[h] = earlier ? drags.targets()[*earlier] : carried[h];
    }
    start.go_on_with(std::move(carried), std::move(targets));
    return start;
}

std::vector<double> carried_over(const Model& from, const std::vector<double>& delays, const Model& to) {
    std::vector<double> carried(to.handles.size());
    for (std::size_t h = 0; h < to.handles.size(); ++h) {
        const ModelObject& object = to.objects[to.handles[h].object];
        std::optional<std::size_t> earlier;
        if (!to.is_body(to.handles[h].object)) {
            const ModelObject* same = find_same_collider(from, object);
            if (same != nullptr) earlier = from.handle_nodes[same->handle_nodes.first].handle;
        } else if (const ModelObject* same = find_same(from, to, object); same && to.handles[h].count > 0) {
            earlier = find_handle(from, *same, nodes_of(to, h));
        }
        if (earlier) carried[h] = delays[*earlier];
    }
    return carried;
}

std::map<std::size_t, HandleArms::Programmed> carried_over(
    const Model& from, const std::map<std::size_t, HandleArms::Programmed>& programmed, const Model& to) {
    std::map<std::size_t, HandleArms::Programmed> carried;
    for (const auto& each : programmed) {
        const std::string& name = from.objects[each.first].name;
        const HandleArms::Programmed& moved = each.second;
        const auto same = std::find_if(to.handles.begin(), to.handles.end(), [&](const Handle& handle) {
            return !to.is_body(handle.object) && handle.animation && !handle.animation->motion &&
                   handle.count == moved.end.size() && to.objects[handle.object].name == name;
        });
        if (same != to.handles.end()) carried[same->object] = moved;
    }
    return carried;
}

std::map<std::size_t, CavityGas> carried_over(const Model& from, const std::map<std::size_t, CavityGas>& gas,
                                              const Model& to) {
    std::map<std::size_t, CavityGas> carried;
    for (const auto& [cavity, set] : gas) {
        const Cavity& of = from.cavities[cavity];
        const auto same = std::find_if(to.cavities.begin(), to.cavities.end(), [&](const Cavity& other) {
            return other.gas.name == of.gas.name && other.gas.law == of.gas.law &&
                   to.objects[other.object].name == from.objects[of.object].name;
        });
        if (same != to.cavities.end()) carried[static_cast<std::size_t>(same - to.cavities.begin())] = set;
    }
    return carried;
}

std::optional<std::size_t> find_same(const Scene& from, std::size_t attachment, const Scene& to) {
    const AttachmentDescription& of = from.attachments[attachment];
    for (std::size_t a = 0; a < to.attachments.size(); ++a) {
        const AttachmentDescription& other = to.attachments[a];
        if (name_of_attachment(other, a) == name_of_attachment(of, attachment) && other.object == of.object &&
            other.where.index() == of.where.index())
            return a;
    }
    return std::nullopt;
}

std::map<std::size_t, JointMotor> carried_over(const Scene& from,
                                               const std::map<std::size_t, JointMotor>& motors,
                                               const Scene& to) {
    std::map<std::size_t, JointMotor> carried;
    for (const auto& [attachment, set] : motors)
        if (const auto same = find_same(from, attachment, to)) carried[*same] = set;
    return carried;
}

}  // namespace gelatin
