#include "mesh/lattice/enclosed_space.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace gelatin::lattice {

EnclosedSpace::EnclosedSpace(const SurfaceMesh& surface)
    : tree_(surface), pieces_(find_pieces(surface)), winding_(surface) {}

// Halves the segment until one face is left in it that is the boundary, or no length. That face is, if the
// surface is closed; in holes no face is, and the bisection goes on.
glm::dvec3 EnclosedSpace::find_boundary(const glm::dvec3& inside, const glm::dvec3& outside) const {
    constexpr int kHalvings = 20;
    const auto point = [&](double at) { return inside + at * (outside - inside); };
    std::vector<Crossing> crossings;
    tree_.find_crossings(inside, outside, crossings);
    double from = 0.0, to = 1.0;  // inside, outside
    for (int halving = 0; halving < kHalvings; ++halving) {
        std::erase_if(crossings, [&](const Crossing& c) { return c.at <= from || c.at >= to; });
        if (!crossings.empty() && crossings.back().at - crossings.front().at < 1e-9) {
            const double at = crossings.front().at;
            if (winding_.is_closed()) return point(at);
            const double before = 0.5 * (from + at), after = 0.5 * (at + to);
            const bool is_inside_before = contains(point(before)), is_inside_after = contains(point(after));
            if (is_inside_before && !is_inside_after) return point(at);
            if (!is_inside_before)
                to = before;
            else
                from = after;
            continue;
        }
        const double middle = 0.5 * (from + to);
        (contains(point(middle)) ? from : to) = middle;
    }
    return point(0.5 * (from + to));
}

Thickness EnclosedSpace::find_thickness(const Triangle& face, double limit) const {
    constexpr double kParallel = -0.7;  // cosine between outward normals
    constexpr double kOffset = 1e-7;    // of the limit: off the face itself
    constexpr std::size_t kMostCrossings = 32;
    const glm::dvec3 area = glm::cross(face[1] - face[0], face[2] - face[0]);
    const double length = glm::length(area);
    if (!(length > 0.0)) return {};
    const glm::dvec3 normal = area / length, center = (face[0] + face[1] + face[2]) / 3.0;
    const glm::dvec3 start = center - kOffset * limit * normal, end = center - limit * normal;
    thread_local std::vector<Crossing> crossings;
    tree_.find_crossings(start, end, crossings);
    if (crossings.empty()) return {{}, false};
    if (crossings.size() > kMostCrossings) return {};
    double winding = winding_(start);
    if (!(winding > 0.5 && winding <= 1.5)) return {};  // the same on both sides of the face
    for (std::size_t k = 0; k < crossings.size(); ++k) {
        const Triangle& other = tree_.faces()[crossings[k].face];
        const glm::dvec3 opposite = glm::cross(other[1] - other[0], other[2] - other[0]);
        const double cosine = glm::dot(normal, opposite);
        winding += cosine < 0.0 ? -1.0 : 1.0;
        const double at = crossings[k].at, next = k + 1 < crossings.size() ? crossings[k + 1].at : 1.0;
        if (winding > 0.5 || next - at < 1e-9) continue;
        if (!winding_.is_closed() && contains(start + 0.5 * (at + next) * (end - start))) continue;
        const double thickness = limit * (kOffset + at * (1.0 - kOffset));
        return {cosine < kParallel * glm::length(opposite) ? std::optional(thickness) : std::nullopt};
    }
    return {{}, false};
}

}  // namespace gelatin::lattice
