#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <utility>

#include "gelatin/error.h"
#include "mesh/fill_contours.h"
#include "mesh/shapes.h"

namespace gelatin {

namespace {

/// Directed edges of triangles that have no triangle on their other side; the region is on their left.
std::vector<glm::uvec2> border(const FlatMesh& mesh) {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<Edge> edges;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
    std::sort(edges.begin(), edges.end());
    std::vector<glm::uvec2> result;
    for (const auto& [a, b] : edges) {
        if (!std::binary_search(edges.begin(), edges.end(), Edge(b, a))) result.emplace_back(a, b);
    }
    return result;
}

/// Caps at z = depth / 2 and -depth / 2, and walls that join the borders of both: closed by construction.
SurfaceMesh extrude(const FlatMesh& cap, double depth) {
    SurfaceMesh mesh;
    const auto back = static_cast<std::uint32_t>(
        cap.positions.size());  // from a front vertex to the corresponding back one
    for (const double z : {0.5 * depth, -0.5 * depth}) {
        for (const glm::dvec2& p : cap.positions) mesh.positions.emplace_back(p, z);
    }
    for (const glm::uvec3& t : cap.triangles) {
        mesh.faces.push_back(t);
        mesh.faces.emplace_back(t[0] + back, t[2] + back, t[1] + back);
    }
    for (const glm::uvec2& edge : border(cap)) {
        mesh.faces.emplace_back(edge[1], edge[0], edge[0] + back);
        mesh.faces.emplace_back(edge[1], edge[0] + back, edge[1] + back);
    }
    return mesh;
}

}  // namespace

SurfaceMesh make_text(const TextShape& shape) {
    FlatMesh cap = fill_contours(outline_text(shape.text, shape.font));
    if (cap.triangles.empty()) {
        throw InvalidInput({{}, 0, "text", "\"" + shape.text + "\"", "has no visible letter"});
    }
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec2& p : cap.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    for (glm::dvec2& p : cap.positions) p = shape.size * (p - 0.5 * (low + high));
    return extrude(cap, shape.depth);
}

}  // namespace gelatin
