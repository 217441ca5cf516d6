#include "sim/carry_over.h"

#include <algorithm>

namespace gelatin {
namespace {

bool have_the_same_tets(const Model& a, const ModelObject& in_a, const Model& b, const ModelObject& in_b) {
    if (in_a.nodes.count != in_b.nodes.count || in_a.tets.count != in_b.tets.count) return false;
    for (std::uint32_t t = 0; t < in_a.tets.count; ++t) {
        if (a.tets[in_a.tets.first + t] - in_a.nodes.first != b.tets[in_b.tets.first + t] - in_b.nodes.first)
            return false;
    }
    return true;
}

// xyz alone; the fourth components are the model's.
void copy_vectors(const std::vector<glm::vec4>& from, const Range& range, std::vector<glm::vec4>& to,
                  std::uint32_t first) {
    for (std::uint32_t n = 0; n < range.count; ++n)
        to[first + n] = glm::vec4(glm::vec3(from[range.first + n]), to[first + n].w);
}

}  // namespace

State carried_over(const Model& from, const State& state, const Model& to, State start) {
    const bool has_earlier = !state.earlier_velocities.empty();
    if (has_earlier) start.earlier_velocities = start.velocities;
    for (const ModelObject& object : to.objects) {
        const auto same =
            std::find_if(from.objects.begin(), from.objects.end(), [&](const ModelObject& other) {
                return other.name == object.name && have_the_same_tets(from, other, to, object);
            });
        if (same == from.objects.end()) continue;
        copy_vectors(state.positions, same->nodes, start.positions, object.nodes.first);
        copy_vectors(state.velocities, same->nodes, start.velocities, object.nodes.first);
        if (has_earlier)
            copy_vectors(state.earlier_velocities, same->nodes, start.earlier_velocities, object.nodes.first);
    }
    return start;
}

}  // namespace gelatin
