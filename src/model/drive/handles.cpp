#include "model/drive/handles.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "model/drive/handle_animation.h"
#include "model/model.h"
#include "model/transform.h"

namespace gelatin {
namespace {

Keyframe interpolated(const Handle& handle, double time) {
    const std::vector<Keyframe>& keyframes = handle.keyframes;
    if (keyframes.empty()) return {};
    const auto next = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                       [](double t, const Keyframe& key) { return t < key.time; });
    if (next == keyframes.begin()) return keyframes.front();
    if (next == keyframes.end()) return keyframes.back();
    const Keyframe &a = *(next - 1), &b = *next;
    double s = (time - a.time) / (b.time - a.time);
    if (handle.interpolation == Interpolation::smooth) s *= s * (3.0 - 2.0 * s);
    return {time, a.move + s * (b.move - a.move), a.turn + s * (b.turn - a.turn),
            a.scale + s * (b.scale - a.scale)};
}

}  // namespace

HandlePose pose_at(const Handle& handle, double time) {
    const Keyframe key = interpolated(handle, time);
    return {handle.pivot + key.move, key.scale * glm::mat3_cast(rotation_from_degrees(key.turn))};
}

HandlePose pose_at(const Handle& handle, double time, const Drag& drag) {
    const HandlePose pose = pose_at(handle, time);
    return {pose.center + drag.move, glm::mat3_cast(drag.turn) * pose.map};
}

bool is_held(const Handle& handle, double time, double step) {
    return time + 0.5 * step < handle.release;
}

std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, double time, double step) {
    const std::vector<Drag> none(handles.size());
    const HandleTimes times{std::vector<double>(handles.size(), time),
                            std::vector<double>(handles.size(), time + step)};
    return handle_motions(handles, none, none, times, step);
}

std::vector<HandleMotion> handle_motions(const std::vector<Handle>& handles, std::span<const Drag> before,
                                         std::span<const Drag> after, const HandleTimes& times, double step) {
    std::vector<HandleMotion> motions;
    for (std::size_t h = 0; h < handles.size(); ++h) {
        const Handle& handle = handles[h];
        const HandlePose start = pose_at(handle, times.begin[h], before[h]);
        const HandlePose end = pose_at(handle, times.end[h], after[h]);
        const auto column = [](const glm::dvec3& v) { return glm::vec4(glm::vec3(v), 0.0f); };
        const auto rate = [&](const glm::dvec3& from, const glm::dvec3& to) {
            return column((to - from) / step);
        };
        motions.push_back(
            {glm::vec4(glm::vec3(start.center), is_held(handle, times.begin[h], step) ? 1.0f : 0.0f),
             column(start.map[0]), column(start.map[1]), column(start.map[2]), rate(start.center, end.center),
             rate(start.map[0], end.map[0]), rate(start.map[1], end.map[1]), rate(start.map[2], end.map[2])});
    }
    return motions;
}

bool any_acts(const std::vector<Handle>& handles, double from, double until, double step) {
    return std::any_of(handles.begin(), handles.end(),
                       [&](const Handle& handle) { return acts(handle, from, until, step); });
}

bool acts(const Handle& handle, double from, double until, double step) {
    if (from > handle.release + step) return false;
    if (until > handle.release - step) return true;
    if (handle.animation && from < handle.animation->end()) return true;
    if (handle.keyframes.empty()) return false;
    const bool begins = from <= 0.0;  // the first keyframe may be anywhere
    return begins || (handle.keyframes.front().time < until && handle.keyframes.back().time > from);
}

std::vector<double> free_inverse_masses(const Model& model, const ModelObject& object) {
    std::vector<double> inverse_masses;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n)
        inverse_masses.push_back(static_cast<double>(model.positions[n].w));
    for (std::uint32_t h = object.handle_nodes.first; h < object.handle_nodes.end(); ++h) {
        const HandleNode& held = model.handle_nodes[h];
        if (std::isfinite(model.handles[held.handle].release))
            inverse_masses[held.node - object.nodes.first] = static_cast<double>(held.arm.w);
    }
    return inverse_masses;
}

}  // namespace gelatin
