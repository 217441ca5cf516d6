#include "model/skin.h"

#include "model/for_each_index.h"

namespace gelatin {

std::vector<glm::vec4> carry_skin(std::span<const SkinPoint> points, std::span<const glm::vec4> positions) {
    std::vector<glm::vec4> at(points.size());
    for_each_index(points.size(), [&](std::size_t p) {
        const auto of_node = [&](std::uint32_t node) { return glm::vec3(positions[node]); };
        at[p] = glm::vec4(carried<glm::vec3>(points[p], of_node), 1.0f);
    });
    return at;
}

std::vector<float> carry_skin(std::span<const SkinPoint> points, std::span<const float> of_nodes) {
    std::vector<float> at(3 * points.size());
    for_each_index(points.size(), [&](std::size_t p) {
        const auto of_node = [&](std::uint32_t node) {
            const float* of = &of_nodes[3 * std::size_t{node}];
            return glm::vec3(of[0], of[1], of[2]);
        };
        const auto vector = carried<glm::vec3>(points[p], of_node);
        for (int k = 0; k < 3; ++k) at[3 * p + static_cast<std::size_t>(k)] = vector[k];
    });
    return at;
}

}  // namespace gelatin
