#include "model/assembly/body_handles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "model/assembly/build_model.h"
#include "model/assembly/make_animation.h"
#include "model/drive/drags.h"
#include "model/region.h"
#include "model/transform.h"

namespace gelatin {
namespace {

double diagonal_of(const std::vector<glm::dvec3>& points) {
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    return glm::distance(low, high);
}

// If the end of a body moves at a fraction of its wave speed, the body is strained by that fraction. Stiff
// bodies could be dragged faster than is useful, so they are limited to their own size in the time by which a
// drag lags behind.
double most_drag_speed(const Body& body, const std::vector<glm::dvec3>& positions) {
    const auto wave_speed = [](const Material& m) { return std::sqrt(m.youngs_modulus / m.density); };
    double speed = wave_speed(body.material);
    for (const Material& part : body.part_materials) speed = std::min(speed, wave_speed(part));
    return std::min(speed / 3.0, kDragRate * diagonal_of(positions));
}

// How a skeleton moves nodes.
std::shared_ptr<const HandleAnimation> animate(const BodySkeleton& skeleton,
                                               const std::vector<std::uint32_t>& nodes,
                                               const std::vector<glm::dvec3>& positions,
                                               const glm::dvec3& pivot) {
    std::vector<glm::dvec3> places;
    for (const std::uint32_t n : nodes) places.push_back(positions[n]);
    HandleAnimation animation = skeleton.hold(places).animation;
    animation.offset -= pivot;
    return std::make_shared<const HandleAnimation>(std::move(animation));
}

void append_handle(const HandleDescription& description, const BodySkeleton* skeleton, Handle handle,
                   const std::vector<glm::dvec3>& positions, std::uint32_t first_node, Model& model) {
    std::vector<std::uint32_t> nodes = nodes_of(description, skeleton, positions);
    std::erase_if(nodes, [&](std::uint32_t n) { return model.positions[first_node + n].w == 0.0f; });
    glm::dvec3 center(0.0);
    for (const std::uint32_t n : nodes) center += positions[n] / static_cast<double>(nodes.size());

    handle.pivot = description.pivot.value_or(center);
    handle.interpolation = description.interpolation;
    handle.keyframes = description.keyframes;
    handle.stops = description.when_blocked == WhenBlocked::stops;
    if (description.release) handle.release = *description.release;
    handle.count = nodes.size();
    handle.middle = center - handle.pivot;
    handle.drag = {description.drag.move, rotation_from_degrees(description.drag.turn)};
    if (skeleton != nullptr) handle.animation = animate(*skeleton, nodes, positions, handle.pivot);
    const auto index = static_cast<std::uint32_t>(model.handles.size());
    for (const std::uint32_t n : nodes) {
        const std::uint32_t node = first_node + n;
        const glm::dvec3 arm = positions[n] - handle.pivot;
        handle.radius = std::max(handle.radius, glm::length(arm));
        glm::vec4& position = model.positions[node];
        model.handle_nodes.push_back({glm::vec4(glm::vec3(arm), position.w), node, index, kNoNode, 0});
        position.w = 0.0f;
        model.velocities[node] = glm::vec4(0.0f, 0.0f, 0.0f, model.velocities[node].w);
    }
    model.handles.push_back(std::move(handle));
}

}  // namespace

std::vector<std::uint32_t> nodes_of(const HandleDescription& handle, const BodySkeleton* skeleton,
                                    const std::vector<glm::dvec3>& positions) {
    return skeleton != nullptr ? skeleton->hold(positions).nodes : find_inside(handle.region, positions);
}

void append_handles(const Body& body, const std::vector<glm::dvec3>& positions, std::uint32_t first_node,
                    Model& model) {
    if (body.handles.empty() && body.pins.empty()) return;
    Handle handle;
    handle.object = model.objects.size();
    handle.most_speed = most_drag_speed(body, positions);
    for (handle.index = 0; handle.index < body.handles.size(); ++handle.index)
        append_handle(body.handles[handle.index], body.skeleton_of(handle.index), handle, positions,
                      first_node, model);
    handle.is_pin = true;
    for (handle.index = 0; handle.index < body.pins.size(); ++handle.index) {
        HandleDescription rests;
        rests.region = body.pins[handle.index];
        append_handle(rests, nullptr, handle, positions, first_node, model);
    }
}

}  // namespace gelatin
