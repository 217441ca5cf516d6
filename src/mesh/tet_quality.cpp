#include "mesh/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin {
namespace {

// The normals of the faces opposite to each corner, twice the area long, outward if the volume is positive.
std::array<glm::dvec3, 4> face_normals(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                       const glm::dvec3& d) {
    return {glm::cross(c - b, d - b), glm::cross(d - a, c - a), glm::cross(b - a, d - a),
            glm::cross(c - a, b - a)};
}

}  // namespace

// sine of the angle at the edge of two faces = 3 V |edge| / (2 A1 A2), with twice the areas 6 V |edge| / (N1
// N2).
double worst_sine(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    const std::array<glm::dvec3, 4> normals = face_normals(a, b, c, d), corners = {a, b, c, d};
    std::array<double, 4> lengths = {};
    for (int k = 0; k < 4; ++k) lengths[k] = glm::length(normals[k]);
    const double volume = glm::dot(glm::cross(b - a, c - a), d - a);  // six times
    double worst = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            const int k = i == 0 ? (j == 1 ? 2 : 1) : 0, l = 6 - i - j - k;  // the edge's ends
            const double areas = lengths[i] * lengths[j];
            if (!(areas > 0.0)) return -1.0;
            worst = std::min(worst, volume * glm::distance(corners[k], corners[l]) / areas);
        }
    }
    return worst;
}

// With u, v, w the edges from d: R = |u.u (v x w) + v.v (w x u) + w.w (u x v)| / (12 V), r = 3 V / area.
double radius_ratio(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    double area = 0.0;
    for (const glm::dvec3& normal : face_normals(a, b, c, d)) area += 0.5 * glm::length(normal);
    const glm::dvec3 u = a - d, v = b - d, w = c - d;
    const double volume = std::abs(glm::dot(u, glm::cross(v, w))) / 6.0;
    const double vector = glm::length(glm::dot(u, u) * glm::cross(v, w) + glm::dot(v, v) * glm::cross(w, u) +
                                      glm::dot(w, w) * glm::cross(u, v));
    return volume > 0.0 ? 108.0 * volume * volume / (area * vector) : 0.0;
}

std::array<double, 6> dihedral_angles(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                      const glm::dvec3& d) {
    const std::array<glm::dvec3, 4> n = face_normals(a, b, c, d);
    std::array<double, 6> angles = {};
    std::size_t count = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = i + 1; j < 4; ++j)
            angles[count++] = std::atan2(glm::length(glm::cross(n[i], n[j])), -glm::dot(n[i], n[j]));
    }
    return angles;
}

}  // namespace gelatin
