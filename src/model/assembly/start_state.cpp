#include "model/assembly/start_state.h"

#include <algorithm>
#include <random>

namespace gelatin {
namespace {

bool is_deformed(const ObjectDescription& object) {
    return object.start.scale != glm::dvec3(1.0) || object.start.scatter > 0.0;
}

glm::dvec3 center_of_mass(const Model& model, const Range& nodes) {
    glm::dvec3 sum(0.0);
    double mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        sum += static_cast<double>(model.masses[n]) * glm::dvec3(model.positions[n]);
        mass += static_cast<double>(model.masses[n]);
    }
    return sum / mass;
}

}  // namespace

std::optional<State> deformed_start(const Scene& scene, const Model& model) {
    if (std::none_of(scene.objects.begin(), scene.objects.end(), is_deformed)) return std::nullopt;
    State state{model.positions, model.velocities, {}};
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
        const StartDescription& start = scene.objects[o].start;
        const Range& nodes = model.objects[o].nodes;
        const glm::dvec3 center = center_of_mass(model, nodes);
        std::mt19937 random(static_cast<std::uint32_t>(o));
        // Uniform in [-1, 1). The standard library's distributions differ between implementations.
        const auto number = [&] { return static_cast<double>(random()) * 0x1p-31 - 1.0; };
        for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
            const double x = number(), y = number(), z = number();
            glm::vec4& position = state.positions[n];
            if (position.w == 0.0f) continue;
            const glm::dvec3 moved =
                center + start.scale * (glm::dvec3(position) - center) + start.scatter * glm::dvec3(x, y, z);
            position = glm::vec4(glm::vec3(moved), position.w);
        }
    }
    return state;
}

}  // namespace gelatin
