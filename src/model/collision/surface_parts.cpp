#include "model/collision/surface_parts.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

namespace gelatin {
namespace {

using Edge = std::array<std::uint32_t, 2>;

std::array<Edge, 3> edges_of(const Face& face) {
    std::array<Edge, 3> edges{Edge{face.a, face.b}, Edge{face.b, face.c}, Edge{face.c, face.a}};
    for (Edge& edge : edges) std::sort(edge.begin(), edge.end());
    return edges;
}

class Parts {
public:
    Parts(std::span<const Face> faces, const NodeFaces& around) : faces_(faces), around_(around) {}

    void append_face(std::uint32_t f) {
        const Face& face = faces_[f];
        parts_.face_starts.emplace_back(parts_.nodes.size(), parts_.edges.size());
        for (const std::uint32_t n : {face.a, face.b, face.c}) {
            const auto first = parts_.nodes.begin() + parts_.face_starts[f].x;
            if (first_face(n) == f && std::find(first, parts_.nodes.end(), n) == parts_.nodes.end())
                parts_.nodes.push_back(n);
        }
        const std::array<Edge, 3> edges = edges_of(face);
        for (std::size_t k = 0; k < 3; ++k) {
            const Edge& edge = edges[k];
            const auto before = edges.begin() + static_cast<std::ptrdiff_t>(k);
            if (edge[0] != edge[1] && std::find(edges.begin(), before, edge) == before && owns(f, edge))
                parts_.edges.push_back({edge[0], edge[1], face.object, f});
        }
    }
    SurfaceParts finish() {
        parts_.face_starts.emplace_back(parts_.nodes.size(), parts_.edges.size());
        return std::move(parts_);
    }

private:
    std::uint32_t first_face(std::uint32_t node) const { return around_.faces[around_.starts[node]]; }
    // Whether no earlier face has the edge: all faces with the edge are around its ends.
    bool owns(std::uint32_t face, const Edge& edge) const {
        for (std::uint32_t k = around_.starts[edge[0]]; around_.faces[k] < face; ++k) {
            const auto others = edges_of(faces_[around_.faces[k]]);
            if (std::find(others.begin(), others.end(), edge) != others.end()) return false;
        }
        return true;
    }

    std::span<const Face> faces_;
    const NodeFaces& around_;
    SurfaceParts parts_;
};

}  // namespace

SurfaceParts make_surface_parts(std::span<const Face> faces, const NodeFaces& around) {
    Parts parts(faces, around);
    for (std::uint32_t f = 0; f < faces.size(); ++f) parts.append_face(f);
    return parts.finish();
}

double median_edge(const Model& model, std::size_t object, std::span<const glm::vec4> positions) {
    const Range& faces = model.objects[object].faces;
    const std::vector<glm::uvec2>& starts = model.surface_parts.face_starts;
    std::vector<double> lengths;
    for (std::uint32_t e = starts[faces.first].y; e < starts[faces.end()].y; ++e) {
        const FaceEdge& edge = model.surface_parts.edges[e];
        lengths.push_back(glm::distance(glm::dvec3(positions[edge.a]), glm::dvec3(positions[edge.b])));
    }
    if (lengths.empty()) return 0.0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

}  // namespace gelatin
