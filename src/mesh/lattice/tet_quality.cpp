#include "mesh/lattice/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin::lattice {
namespace {

// The normals of the faces opposite to each corner, twice the area long, outward if the volume is positive.
std::array<glm::dvec3, 4> face_normals(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                       const glm::dvec3& d) {
    return {glm::cross(c - b, d - b), glm::cross(d - a, c - a), glm::cross(b - a, d - a),
            glm::cross(c - a, b - a)};
}

}  // namespace

// sine of the angle at the edge of two faces = 3 V |edge| / (2 A1 A2), with twice the areas 6 V |edge| / (N1 N2).
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

}  // namespace gelatin::lattice
