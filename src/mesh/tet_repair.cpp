#include "mesh/tet_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "gelatin/error.h"
#include "mesh/merge_points.h"
#include "mesh/tet_check.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

double longest_edge(const TetMesh& mesh, const glm::uvec4& tet) {
    double longest = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            longest = std::max(longest, distance(mesh.positions[tet[i]], mesh.positions[tet[j]]));
        }
    }
    return longest;
}

// Flips inverted tets; flat ones have no orientation.
void orient_tets(const std::string& name, TetMesh& mesh, Notes& notes) {
    constexpr double kFlat = 1e-12;  // of the longest edge cubed
    std::size_t flipped = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        glm::uvec4& tet = mesh.tets[t];
        const double volume = tet_volume(mesh, tet);
        const double longest = longest_edge(mesh, tet);
        if (!(std::abs(volume) > kFlat * longest * longest * longest)) {
            throw InvalidInput({name,
                                0,
                                fmt::format("tet {}", t + 1),
                                {},
                                fmt::format("is flat: its volume is {:.3g} m^3, its longest edge {:.3g} m",
                                            volume, longest)});
        }
        if (volume > 0.0) continue;
        std::swap(tet[2], tet[3]);
        ++flipped;
    }
    if (flipped > 0) notes.push_back(fmt::format("flipped inverted tets: {}", flipped));
}

// Gmsh writes a tet with several physical groups once for each of them.
void drop_repeated_tets(TetMesh& mesh, Notes& notes) {
    struct Key {
        std::array<std::uint32_t, 4> nodes;
        std::size_t tet;
    };
    std::vector<Key> keys;
    keys.reserve(mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const glm::uvec4& tet = mesh.tets[t];
        keys.push_back({{tet[0], tet[1], tet[2], tet[3]}, t});
        std::sort(keys.back().nodes.begin(), keys.back().nodes.end());
    }
    std::sort(keys.begin(), keys.end(),
              [](const Key& a, const Key& b) { return std::tie(a.nodes, a.tet) < std::tie(b.nodes, b.tet); });
    std::vector<bool> keep(mesh.tets.size(), true);
    for (std::size_t k = 1; k < keys.size(); ++k) keep[keys[k].tet] = keys[k].nodes != keys[k - 1].nodes;
    const std::size_t dropped = keep_tets(mesh, keep);
    if (dropped > 0) notes.push_back(fmt::format("discarded duplicate tets: {}", dropped));
}

// Discards nodes without tets. Returns how many.
std::size_t drop_unused_nodes(TetMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec4& tet : mesh.tets) {
        for (int corner = 0; corner < 4; ++corner) used[tet[corner]] = true;
    }
    std::vector<std::uint32_t> new_index(mesh.positions.size());
    std::uint32_t kept = 0;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (!used[n]) continue;
        mesh.positions[kept] = mesh.positions[n];
        new_index[n] = kept++;
    }
    const std::size_t dropped = mesh.positions.size() - kept;
    mesh.positions.resize(kept);
    for (glm::uvec4& tet : mesh.tets) {
        tet = {new_index[tet[0]], new_index[tet[1]], new_index[tet[2]], new_index[tet[3]]};
    }
    return dropped;
}

// Tets without common nodes would fall apart. Some programs write each tet with its own nodes.
void merge_nodes(TetMesh& mesh, Notes& notes) {
    const MergedPoints merged = merge_points(mesh.positions, kCoincidentNodes);
    if (merged.count == 0) return;
    for (glm::uvec4& tet : mesh.tets) {
        for (int corner = 0; corner < 4; ++corner) tet[corner] = merged.into[tet[corner]];
    }
    drop_unused_nodes(mesh);
    notes.push_back(fmt::format("merged nodes that coincide: {}", merged.count));
}

}  // namespace

void repair_tets(TetMesh& mesh, const std::string& name, Notes& notes) {
    const auto is_zero = [](int attribute) { return attribute == 0; };
    if (std::all_of(mesh.attributes.begin(), mesh.attributes.end(), is_zero)) mesh.attributes.clear();
    if (const std::size_t dropped = drop_unused_nodes(mesh); dropped > 0)
        notes.push_back(fmt::format("discarded nodes without tets: {}", dropped));
    merge_nodes(mesh, notes);
    orient_tets(name, mesh, notes);
    drop_repeated_tets(mesh, notes);
    check_tets(mesh, notes);
    mesh.faces = boundary_faces(mesh.tets);
}

}  // namespace gelatin
