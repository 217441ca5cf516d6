#include "model/assembly/draw_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "core/disjoint_sets.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

// Corner 3 f + k is vertex k of face f.
std::uint32_t corner_of(const glm::uvec3& face, std::uint32_t face_index, std::uint32_t node) {
    for (int k = 0; k < 3; ++k) {
        if (face[k] == node) return 3 * face_index + static_cast<std::uint32_t>(k);
    }
    return 3 * face_index;
}

glm::dvec3 unit_normal(std::span<const glm::vec4> positions, const glm::uvec3& face) {
    const glm::dvec3 a(positions[face.x]), b(positions[face.y]), c(positions[face.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    return length > 0.0 ? n / length : glm::dvec3(0.0);
}

DisjointSets group_smooth_corners(std::span<const glm::vec4> positions, const std::vector<glm::uvec3>& faces,
                                  double crease_angle) {
    DisjointSets groups(3 * faces.size());
    const double smooth_cosine = std::cos(crease_angle);
    for (const SurfaceEdge& edge : surface_edges(faces)) {
        const auto [f, g] = edge.faces;
        if (glm::dot(unit_normal(positions, faces[f]), unit_normal(positions, faces[g])) < smooth_cosine)
            continue;
        for (const std::uint32_t node : {edge.nodes.x, edge.nodes.y}) {
            groups.unite(corner_of(faces[f], f, node), corner_of(faces[g], g, node));
        }
    }
    return groups;
}

}  // namespace

void append_draw_surface(std::span<const glm::vec4> positions, std::span<const Face> all_faces, Range range,
                         double crease_angle, DrawSurface& surface,
                         std::span<const std::array<glm::vec2, 3>> corner_uvs) {
    // Nodes are counted from the object's first. Otherwise each of a thousand objects would search the nodes
    // of all.
    const std::span<const Face> own_faces = all_faces.subspan(range.first, range.count);
    std::uint32_t first_node = std::numeric_limits<std::uint32_t>::max();
    for (const Face& face : own_faces) first_node = std::min({first_node, face.a, face.b, face.c});
    std::vector<glm::uvec3> faces;
    for (const Face& face : own_faces) faces.push_back(glm::uvec3(face.a, face.b, face.c) - first_node);
    DisjointSets groups =
        group_smooth_corners(positions.subspan(range.count > 0 ? first_node : 0), faces, crease_angle);

    // Numbers the groups by their nodes, so that drawing reads memory in the same order as the simulation.
    std::vector<std::uint32_t> corners(3 * faces.size());
    std::iota(corners.begin(), corners.end(), 0u);
    const auto node_of = [&](std::uint32_t corner) {
        return faces[corner / 3][static_cast<int>(corner % 3)];
    };
    const bool has_uvs = !corner_uvs.empty();
    const auto uv_of = [&](std::uint32_t corner) {
        return has_uvs ? corner_uvs[range.first + corner / 3][corner % 3] : glm::vec2(0.0f);
    };
    std::vector<std::uint32_t> root(corners.size());
    for (const std::uint32_t c : corners) root[c] = groups.least(c);
    std::sort(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (node_of(a) != node_of(b)) return node_of(a) < node_of(b);
        if (root[a] != root[b]) return root[a] < root[b];
        const glm::vec2 p = uv_of(a), q = uv_of(b);
        return std::tie(p.x, p.y, a) < std::tie(q.x, q.y, b);
    });

    const std::size_t first_triangle = surface.triangles.size();
    surface.triangles.resize(first_triangle + faces.size());
    // Vertices of one smooth side of a node have the same faces, so that their normals are equal.
    std::size_t side = 0;  // its first vertex
    for (std::size_t n = 0; n < corners.size(); ++n) {
        const std::uint32_t corner = corners[n];
        const bool is_other_side = n == 0 || root[corner] != root[corners[n - 1]];
        if (is_other_side) side = surface.vertices.size();
        if (is_other_side || uv_of(corner) != uv_of(corners[n - 1])) {
            SurfaceVertex vertex{first_node + node_of(corner), all_faces[range.first].object,
                                 static_cast<std::uint32_t>(surface.vertex_faces.size()), 0};
            if (!is_other_side) {
                vertex.first_face = surface.vertices[side].first_face;
                vertex.face_count = surface.vertices[side].face_count;
            }
            surface.vertices.push_back(vertex);
            if (has_uvs) surface.uvs.push_back(uv_of(corner));
        }
        for (std::size_t v = side; v < surface.vertices.size(); ++v) ++surface.vertices[v].face_count;
        surface.vertex_faces.push_back(range.first + corner / 3);
        surface.triangles[first_triangle + corner / 3][static_cast<int>(corner % 3)] =
            static_cast<std::uint32_t>(surface.vertices.size() - 1);
    }
}

}  // namespace gelatin
