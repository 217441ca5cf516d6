#include "mesh/local_origin.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin {
namespace {

// The length that all but one of a hundred edges exceed: a few that are shorter are faults of the surface.
double short_edge(const SurfaceMesh& mesh, double extent) {
    std::vector<double> lengths;
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            const double length = distance(mesh.positions[face[k]], mesh.positions[face[(k + 1) % 3]]);
            if (length > 1e-9 * extent) lengths.push_back(length);  // others coincide and are merged
        }
    }
    if (lengths.empty()) return extent;
    const auto place = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 100);
    std::nth_element(lengths.begin(), place, lengths.end());
    return *place;
}

}  // namespace

void move_near_origin(SurfaceMesh& mesh, Notes& notes) {
    if (mesh.faces.empty()) return;
    glm::dvec3 low = mesh.positions[mesh.faces[0][0]], high = low;
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) {
            low = min(low, mesh.positions[face[k]]);
            high = max(high, mesh.positions[face[k]]);
        }
    }
    const double extent = distance(low, high);
    const glm::dvec3 farthest = max(abs(low), abs(high));
    const double reach = std::max({farthest.x, farthest.y, farthest.z});
    constexpr double kGain = 8.0;  // less would save fewer than three bits
    if (reach <= kGain * extent || extent == 0.0) return;
    constexpr double kRoundedBy = 0.01;  // as much of the shortest spring is what a scene is warned of
    const double spacing = reach * std::numeric_limits<float>::epsilon();
    if (spacing <= kRoundedBy * short_edge(mesh, extent)) return;

    // A round number, so that users can place the body by it.
    const double unit = std::pow(10.0, std::floor(std::log10(extent)));
    const glm::dvec3 origin = round((low + high) / (2.0 * unit)) * unit;
    for (glm::dvec3& position : mesh.positions) position -= origin;
    notes.push_back(
        fmt::format("moved by ({:.15g}, {:.15g}, {:.15g}) to the origin, as single precision would round its "
                    "edges by more "
                    "than a hundredth where it is",
                    -origin.x + 0.0, -origin.y + 0.0, -origin.z + 0.0));
}

}  // namespace gelatin
