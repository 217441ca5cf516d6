#include "model/model.h"

#include "model/spring_packing.h"

#include <algorithm>

namespace gelatin {

bool Model::has_damping() const {
    return std::any_of(velocities.begin(), velocities.end(), [](const glm::vec4& v) { return v.w > 0.0f; });
}

bool Model::has_rigid_bodies() const {
    return std::any_of(objects.begin(), objects.end(),
                       [](const ModelObject& object) { return object.is_rigid; });
}

std::vector<std::uint32_t> places_on_surface(const Model& model) {
    std::vector<std::uint32_t> places(model.node_count(), kNoNode);
    const std::vector<std::uint32_t>& nodes = model.surface_parts.nodes;
    for (std::uint32_t s = 0; s < nodes.size(); ++s) places[nodes[s]] = s;
    return places;
}

std::vector<std::uint32_t> objects_of_nodes(const Model& model) {
    std::vector<std::uint32_t> objects(model.node_count(), 0);
    for (std::uint32_t o = 0; o < model.objects.size(); ++o) {
        const Range& nodes = model.objects[o].nodes;
        std::fill_n(objects.begin() + nodes.first, nodes.count, o);
    }
    return objects;
}

}  // namespace gelatin
