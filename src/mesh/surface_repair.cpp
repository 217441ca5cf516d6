#include "mesh/surface_repair.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>

#include "mesh/edge_uses.h"
#include "mesh/merge_points.h"
#include "mesh/surface_winding.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kDiscarded = ~0u;

// Replaces coincident vertices in the faces by the first of them. Returns the number of the others.
std::size_t merge_vertices(SurfaceMesh& mesh) {
    const MergedPoints merged = merge_points(mesh.positions, 1e-9);
    for (glm::uvec3& face : mesh.faces) {
        face = {merged.into[face[0]], merged.into[face[1]], merged.into[face[2]]};
    }
    return merged.count;
}

bool is_degenerate(const SurfaceMesh& mesh, const glm::uvec3& face) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return true;
    const glm::dvec3 a = mesh.positions[face[0]], ab = mesh.positions[face[1]] - a,
                     ac = mesh.positions[face[2]] - a;
    return length(cross(ab, ac)) <= 1e-14 * std::max(dot(ab, ab), dot(ac, ac));
}

// Of each face, if there are any.
void drop(auto& values, const std::vector<bool>& is_dropped) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t f = 0; f < is_dropped.size(); ++f) {
        if (!is_dropped[f]) values[kept++] = values[f];
    }
    values.resize(kept);
}

// Returns how many.
std::size_t drop_faces(SurfaceMesh& mesh, const std::vector<bool>& is_dropped) {
    const std::size_t before = mesh.faces.size();
    drop(mesh.faces, is_dropped);
    drop(mesh.look.face_materials, is_dropped);
    drop(mesh.look.corner_uvs, is_dropped);
    return before - mesh.faces.size();
}

std::size_t drop_degenerate_faces(SurfaceMesh& mesh) {
    std::vector<bool> is_dropped;
    for (const glm::uvec3& face : mesh.faces) is_dropped.push_back(is_degenerate(mesh, face));
    return drop_faces(mesh, is_dropped);
}

// Keeps the first face of each set of three vertices, whatever their winding.
std::size_t drop_repeated_faces(SurfaceMesh& mesh) {
    struct Key {
        std::array<std::uint32_t, 3> vertices;
        std::uint32_t face;
    };
    std::vector<Key> keys;
    keys.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        keys.push_back({{mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2]}, f});
        std::sort(keys.back().vertices.begin(), keys.back().vertices.end());
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return std::tie(a.vertices, a.face) < std::tie(b.vertices, b.face);
    });
    std::vector<bool> repeated(mesh.faces.size(), false);
    for (std::size_t k = 1; k < keys.size(); ++k)
        repeated[keys[k].face] = keys[k].vertices == keys[k - 1].vertices;
    return drop_faces(mesh, repeated);
}

std::size_t drop_unused_vertices(SurfaceMesh& mesh) {
    std::vector<std::uint32_t> new_index(mesh.positions.size(), kDiscarded);
    for (const glm::uvec3& face : mesh.faces) {
        for (int corner = 0; corner < 3; ++corner) new_index[face[corner]] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (new_index[v] == kDiscarded) continue;
        mesh.positions[kept] = mesh.positions[v];
        new_index[v] = kept++;
    }
    for (glm::uvec3& face : mesh.faces) face = {new_index[face[0]], new_index[face[1]], new_index[face[2]]};
    const std::size_t dropped = mesh.positions.size() - kept;
    mesh.positions.resize(kept);
    return dropped;
}

}  // namespace

void repair_surface(SurfaceMesh& mesh, Notes& notes) {
    const auto note = [&](std::size_t count, const char* text) {
        if (count > 0) notes.push_back(fmt::format(fmt::runtime(text), count));
    };
    const std::size_t merged = merge_vertices(mesh);
    note(merged, "merged vertices that coincide: {}");
    note(drop_degenerate_faces(mesh), "discarded faces without area: {}");
    note(drop_repeated_faces(mesh), "discarded duplicate faces: {}");
    note(drop_unused_vertices(mesh) - merged, "discarded vertices without faces: {}");
    const WindingRepair winding = orient_faces_outward(mesh);
    note(winding.flipped_faces, "flipped faces with the wrong orientation: {}");
    note(winding.cavities,
         "cavities, as these closed pieces and the body around have opposite orientations: {}");
    note(winding.enclosed_bodies, "closed pieces inside cavities, which are bodies of their own: {}");
    if (winding.overlapping_bodies > 0) {
        drop_faces(mesh, winding.is_enclosed);
        drop_unused_vertices(mesh);
    }
    note(
        winding.overlapping_bodies,
        "discarded closed pieces inside a body of the same orientation, which are bodies that overlap it and "
        "no cavities (reverse their faces to make them cavities): {}");
    note(winding.contrary_edges,
         "edges whose two faces cannot have the same orientation, as on a one-sided surface: {}");
}

Openness measure_openness(const SurfaceMesh& mesh) {
    Openness openness;
    const std::vector<EdgeUse> uses = sorted_edge_uses(mesh.faces);
    for_each_edge(std::span<const EdgeUse>(uses), [&](std::span<const EdgeUse> edge) {
        if (edge.size() == 1) ++openness.boundary_edges;
        if (edge.size() > 2) ++openness.non_manifold_edges;
    });
    return openness;
}

double signed_volume(const SurfaceMesh& mesh) {
    if (mesh.faces.empty()) return 0.0;
    double volume = 0.0;
    const glm::dvec3 origin = mesh.positions[mesh.faces[0][0]];  // near, against cancellation
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 a = mesh.positions[face[0]] - origin, b = mesh.positions[face[1]] - origin,
                         c = mesh.positions[face[2]] - origin;
        volume += dot(a, cross(b, c)) / 6.0;
    }
    return volume;
}

}  // namespace gelatin
