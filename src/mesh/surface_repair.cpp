#include "mesh/surface_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>
#include <unordered_map>

#include "mesh/edge_uses.h"
#include "mesh/surface_winding.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kNone = ~0u;

// Vertices that are kept, in cells of a few tolerances, so that one near to a point is found in the cells
// around it. Kept vertices lie a tolerance apart, so a cell holds few of them however the mesh is made.
class VertexGrid {
public:
    VertexGrid(const std::vector<glm::dvec3>& positions, const glm::dvec3& origin, double tolerance)
        : positions_(positions), origin_(origin), tolerance_(tolerance), cell_size_(8.0 * tolerance) {
        first_in_cell_.reserve(positions.size());
        next_in_cell_.assign(positions.size(), kNone);
    }

    std::uint32_t find_near(const glm::dvec3& p) const {
        const Cell low = cell_of(p - tolerance_), high = cell_of(p + tolerance_);
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const std::uint32_t found = find_in_cell({x, y, z}, p);
                    if (found != kNone) return found;
                }
            }
        }
        return kNone;
    }

    void add(std::uint32_t vertex) {
        const auto [entry, is_new] = first_in_cell_.try_emplace(hash(cell_of(positions_[vertex])), vertex);
        if (is_new) return;
        next_in_cell_[vertex] = entry->second;
        entry->second = vertex;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const glm::dvec3& p) const {
        if (cell_size_ <= 0.0) return {0, 0, 0};
        const glm::dvec3 cell = floor((p - origin_) / cell_size_);
        return {static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                static_cast<std::int64_t>(cell.z)};
    }

    // Cells that share a hash only cost a few more distances.
    static std::uint64_t hash(const Cell& cell) {
        std::uint64_t h = 0;
        for (const std::int64_t c : cell) {
            h = (h ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        return h;
    }

    std::uint32_t find_in_cell(const Cell& cell, const glm::dvec3& p) const {
        const auto entry = first_in_cell_.find(hash(cell));
        if (entry == first_in_cell_.end()) return kNone;
        for (std::uint32_t v = entry->second; v != kNone; v = next_in_cell_[v]) {
            if (distance(positions_[v], p) <= tolerance_) return v;
        }
        return kNone;
    }

    const std::vector<glm::dvec3>& positions_;
    glm::dvec3 origin_;
    double tolerance_, cell_size_;
    std::unordered_map<std::uint64_t, std::uint32_t> first_in_cell_;
    std::vector<std::uint32_t> next_in_cell_;
};

// Points the faces at the first of the vertices that coincide. Returns how many others there are.
std::size_t merge_vertices(SurfaceMesh& mesh) {
    if (mesh.positions.empty()) return 0;
    glm::dvec3 low = mesh.positions[0], high = low;
    for (const glm::dvec3& p : mesh.positions) {
        low = min(low, p);
        high = max(high, p);
    }
    VertexGrid kept(mesh.positions, low, 1e-9 * distance(low, high));
    std::vector<std::uint32_t> merged_into(mesh.positions.size());
    std::size_t merged = 0;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const std::uint32_t near = kept.find_near(mesh.positions[v]);
        merged_into[v] = near == kNone ? v : near;
        if (near == kNone) {
            kept.add(v);
        } else {
            ++merged;
        }
    }
    for (glm::uvec3& face : mesh.faces) {
        face = {merged_into[face[0]], merged_into[face[1]], merged_into[face[2]]};
    }
    return merged;
}

bool is_degenerate(const SurfaceMesh& mesh, const glm::uvec3& face) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return true;
    const glm::dvec3 a = mesh.positions[face[0]], ab = mesh.positions[face[1]] - a,
                     ac = mesh.positions[face[2]] - a;
    return length(cross(ab, ac)) <= 1e-14 * std::max(dot(ab, ab), dot(ac, ac));
}

std::size_t drop_degenerate_faces(SurfaceMesh& mesh) {
    return std::erase_if(mesh.faces, [&](const glm::uvec3& face) { return is_degenerate(mesh, face); });
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
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        if (!repeated[f]) mesh.faces[kept++] = mesh.faces[f];
    }
    const std::size_t dropped = mesh.faces.size() - kept;
    mesh.faces.resize(kept);
    return dropped;
}

std::size_t drop_unused_vertices(SurfaceMesh& mesh) {
    std::vector<std::uint32_t> new_index(mesh.positions.size(), kNone);
    for (const glm::uvec3& face : mesh.faces) {
        for (int corner = 0; corner < 3; ++corner) new_index[face[corner]] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (new_index[v] == kNone) continue;
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
    note(drop_degenerate_faces(mesh), "dropped faces without area: {}");
    note(drop_repeated_faces(mesh), "dropped repeated faces: {}");
    note(drop_unused_vertices(mesh) - merged, "dropped vertices without faces: {}");
    const WindingRepair winding = turn_faces_outward(mesh);
    note(winding.turned_faces, "turned faces that wound the wrong way: {}");
    note(winding.contrary_edges, "edges whose two faces cannot wind alike, as on a one-sided surface: {}");
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
    double volume = 0.0;
    for (const glm::uvec3& face : mesh.faces) {
        const glm::dvec3 &a = mesh.positions[face[0]], &b = mesh.positions[face[1]],
                         &c = mesh.positions[face[2]];
        volume += dot(a, cross(b, c)) / 6.0;
    }
    return volume;
}

}  // namespace gelatin
