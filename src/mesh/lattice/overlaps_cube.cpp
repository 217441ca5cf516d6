#include "mesh/lattice/overlaps_cube.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace gelatin::lattice {

bool overlaps_cube(const Triangle& face, const glm::dvec3& center, double half_edge) {
    const double half = half_edge * (1.0 + 1e-9);
    const Triangle v = {face[0] - center, face[1] - center, face[2] - center};
    const auto separates = [&](const glm::dvec3& axis) {
        const double a = glm::dot(v[0], axis), b = glm::dot(v[1], axis), c = glm::dot(v[2], axis);
        const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
    };
    const glm::dvec3 low = glm::min(glm::min(v[0], v[1]), v[2]), high = glm::max(glm::max(v[0], v[1]), v[2]);
    if (glm::any(glm::greaterThan(low, glm::dvec3(half))) || glm::any(glm::lessThan(high, glm::dvec3(-half))))
        return false;
    const Triangle edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    if (separates(glm::cross(edges[0], edges[1]))) return false;
    for (const glm::dvec3& e : edges) {
        if (separates({0.0, -e.z, e.y}) || separates({e.z, 0.0, -e.x}) || separates({-e.y, e.x, 0.0}))
            return false;
    }
    return true;
}

}  // namespace gelatin::lattice
