#include "dragged_scene.h"

#include <algorithm>
#include <cstddef>

#include "model/transform.h"

namespace gelatin::viewer {
namespace {

void remove_pin(ObjectDescription& object, std::size_t index) {
    object.pins.erase(object.pins.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace

Scene dragged_scene(Scene scene, const std::vector<HeldNodes>& held) {
    // Handles before pins, because pins become handles and are appended; of pins the last first, so that the
    // indices of the others do not change.
    std::vector<HeldNodes> ordered = held;
    std::sort(ordered.begin(), ordered.end(), [](const HeldNodes& a, const HeldNodes& b) {
        return a.is_pin != b.is_pin ? b.is_pin : a.index > b.index;
    });
    for (const HeldNodes& nodes : ordered) {
        ObjectDescription& object = scene.objects[nodes.object];
        const DragDescription drag{nodes.target.move, degrees_from_rotation(nodes.target.turn)};
        if (!nodes.is_pin) {
            object.handles[nodes.index].drag = drag;
        } else if (nodes.target != Drag()) {
            HandleDescription handle;
            handle.region = object.pins[nodes.index];
            handle.drag = drag;
            object.handles.push_back(handle);
            remove_pin(object, nodes.index);
        }
    }
    return scene;
}

Scene released_scene(Scene scene, const HeldNodes& held) {
    ObjectDescription& object = scene.objects[held.object];
    if (held.is_pin) {
        remove_pin(object, held.index);
    } else {
        object.handles.erase(object.handles.begin() + static_cast<std::ptrdiff_t>(held.index));
    }
    return scene;
}

}  // namespace gelatin::viewer
