#include "mesh/lattice/overlaps_cube.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gelatin::lattice {

bool overlaps_cube(const Triangle& face, const glm::dvec3& center, double half_edge) {
    const double half = half_edge * (1.0 + 1e-9);
    const Triangle v = {face[0] - center, face[1] - center, face[2] - center};
    const auto separates = [&](const glm::dvec3& axis) {
        const double a = glm::dot(v[0], axis), b = glm::dot(v[1], axis), c = glm::dot(v[2], axis);
        const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
    };
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 axis(0.0);
        axis[k] = 1.0;
        if (separates(axis)) return false;
    }
    const Triangle edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    if (separates(glm::cross(edges[0], edges[1]))) return false;
    for (const glm::dvec3& e : edges) {
        if (separates({0.0, -e.z, e.y}) || separates({e.z, 0.0, -e.x}) || separates({-e.y, e.x, 0.0}))
            return false;
    }
    return true;
}

}  // namespace gelatin::lattice
