#include "support/overlaps.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "exact/triangle_overlap.h"
#include "model/corners.h"

namespace gelatin::test {
namespace {

int corners_in_common(const Face& f, const Face& g) {
    return int(has_corner(g, f.a)) + int(has_corner(g, f.b)) + int(has_corner(g, f.c));
}

struct Extent {
    glm::dvec3 low, high;
    std::uint32_t face;
};

}  // namespace

// By sorting the faces along x.
std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<double>> positions, Overlaps which,
                           const JoinedBodies& joined) {
    const auto triangle = [&](std::uint32_t f) {
        const Face& face = model.faces[f];
        return cpu::Triangle<double>{glm::dvec3(positions[face.a]), glm::dvec3(positions[face.b]),
                                     glm::dvec3(positions[face.c])};
    };
    std::vector<Extent> extents;
    for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
        const auto corners = triangle(f);
        extents.push_back({glm::min(glm::min(corners[0], corners[1]), corners[2]),
                           glm::max(glm::max(corners[0], corners[1]), corners[2]), f});
    }
    std::sort(extents.begin(), extents.end(),
              [](const Extent& a, const Extent& b) { return a.low.x < b.low.x; });
    // Of two faces with one corner in common: of the first, the edge that does not have it.
    const auto edge_passes = [&](std::uint32_t f, std::uint32_t g) {
        if (corners_in_common(model.faces[f], model.faces[g]) != 1) return false;
        cpu::Triangle<double> edge = triangle(f);
        const auto nodes = corners_of(model.faces[f]);
        for (std::size_t k = 0; k < 3; ++k)
            if (has_corner(model.faces[g], nodes[k])) edge[k] = edge[(k + 1) % 3];
        return exactly_overlap(edge, triangle(g));
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < extents.size(); ++i) {
        for (std::size_t j = i + 1; j < extents.size() && extents[j].low.x <= extents[i].high.x; ++j) {
            const Extent &a = extents[i], &b = extents[j];
            const std::uint32_t object = model.faces[a.face].object, other = model.faces[b.face].object;
            if (!model.is_body(object) && !model.is_body(other)) continue;
            if (object == other && which == Overlaps::between) continue;
            if (are_joined(joined, object, other)) continue;
            if (glm::any(glm::greaterThan(a.low, b.high)) || glm::any(glm::greaterThan(b.low, a.high)))
                continue;
            if (object != other || corners_in_common(model.faces[a.face], model.faces[b.face]) == 0) {
                if (exactly_overlap(triangle(a.face), triangle(b.face))) ++count;
            } else if (edge_passes(a.face, b.face) || edge_passes(b.face, a.face)) {
                ++count;
            }
        }
    }
    return count;
}

std::size_t count_overlaps(const Model& model, std::span<const cpu::Vec4<float>> positions, Overlaps which,
                           const JoinedBodies& joined) {
    const std::vector<cpu::Vec4<double>> exact(positions.begin(), positions.end());
    return count_overlaps(model, std::span<const cpu::Vec4<double>>(exact), which, joined);
}

}  // namespace gelatin::test
