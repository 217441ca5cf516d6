#include "markers.h"

#include <fmt/core.h>

#include <glm/geometric.hpp>

#include "handle_drag.h"

namespace gelatin::viewer {
namespace {

bool rests(const HeldNodes& nodes, const ObjectDescription& object) {
    return nodes.is_pin || object.handles[nodes.index].keyframes.empty();
}

}  // namespace

std::vector<Marker> make_markers(const std::vector<HeldNodes>& held, const Scene& scene,
                                 const CameraController& camera) {
    std::vector<Marker> markers;
    for (std::size_t h = 0; h < held.size(); ++h) {
        const HeldNodes& nodes = held[h];
        if (nodes.count == 0 || nodes.is_released) continue;
        const auto place = camera.place_of(glm::vec3(nodes.center));
        const auto target = camera.place_of(glm::vec3(target_center(nodes)));
        if (!place || !target) continue;
        const ObjectDescription& object = scene.objects[nodes.object];
        const bool is_pin = rests(nodes, object);
        markers.push_back(
            {h, is_pin, *place, *target, fmt::format("{} of '{}'", is_pin ? "pin" : "handle", object.name)});
    }
    return markers;
}

const Marker* find_marker(const std::vector<Marker>& markers, const glm::vec2& pointer, float reach) {
    const Marker* nearest = nullptr;
    for (const Marker& marker : markers) {
        const float distance = glm::distance(marker.target, pointer);
        if (distance > reach) continue;
        reach = distance;
        nearest = &marker;
    }
    return nearest;
}

}  // namespace gelatin::viewer
