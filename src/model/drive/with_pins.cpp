#include "model/drive/with_pins.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "model/drive/drags.h"
#include "model/spring_packing.h"

namespace gelatin {
namespace {

// As of the scene's own pins (body_handles.cpp), from the softest tet.
double most_drag_speed(const Model& model, const ModelObject& object) {
    constexpr double kYoungsOverShear = 2.5;
    float softest = model.shear_moduli[object.tets.first];
    for (std::uint32_t t = object.tets.first; t < object.tets.end(); ++t)
        softest = std::min(softest, model.shear_moduli[t]);
    const double density = object.mass / object.rest_volume;
    const double wave_speed = std::sqrt(kYoungsOverShear * static_cast<double>(softest) / density);
    glm::vec3 low(model.positions[object.nodes.first]), high = low;
    for (std::uint32_t n = object.nodes.first; n < object.nodes.end(); ++n) {
        low = glm::min(low, glm::vec3(model.positions[n]));
        high = glm::max(high, glm::vec3(model.positions[n]));
    }
    return std::min(wave_speed / 3.0, kDragRate * static_cast<double>(glm::distance(low, high)));
}

void append_pin(const AddedPin& pin, std::size_t index, Model& model) {
    Handle handle;
    for (const glm::vec3& place : pin.places)
        handle.pivot += glm::dvec3(place) / static_cast<double>(pin.places.size());
    handle.object = pin.object;
    handle.is_pin = handle.is_added = true;
    handle.index = index;
    handle.count = pin.nodes.size();
    handle.most_speed = most_drag_speed(model, model.objects[pin.object]);
    for (std::size_t k = 0; k < pin.nodes.size(); ++k) {
        const glm::dvec3 arm = glm::dvec3(pin.places[k]) - handle.pivot;
        handle.radius = std::max(handle.radius, glm::length(arm));
        glm::vec4& position = model.positions[pin.nodes[k]];
        const auto number = static_cast<std::uint32_t>(model.handles.size());
        model.handle_nodes.push_back(
            {glm::vec4(glm::vec3(arm), position.w), pin.nodes[k], number, kNoNode, 0});
        position.w = 0.0f;
        glm::vec4& velocity = model.velocities[pin.nodes[k]];
        velocity = glm::vec4(0.0f, 0.0f, 0.0f, velocity.w);
    }
    model.handles.push_back(std::move(handle));
}

}  // namespace

Model with_pins(const Model& model, const std::vector<AddedPin>& pins) {
    Model result = model;
    result.handles.clear();
    result.handle_nodes.clear();
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        Range& own = result.objects[o].handle_nodes;
        own.first = static_cast<std::uint32_t>(result.handle_nodes.size());
        std::size_t pin_count = 0;
        for (std::uint32_t h = 0; h < model.handles.size(); ++h) {
            if (model.handles[h].object != o) continue;
            for (HandleNode held : model.handle_nodes) {
                if (held.handle != h) continue;
                held.handle = static_cast<std::uint32_t>(result.handles.size());
                result.handle_nodes.push_back(held);
            }
            result.handles.push_back(model.handles[h]);
            pin_count += model.handles[h].is_pin ? 1 : 0;
        }
        for (const AddedPin& pin : pins)
            if (pin.object == o) append_pin(pin, pin_count++, result);
        own.count = static_cast<std::uint32_t>(result.handle_nodes.size()) - own.first;
    }
    return result;
}

}  // namespace gelatin
