#include "mesh/tet_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "core/counted.h"
#include "mesh/topology.h"

namespace gelatin {
namespace {

// Explicit solvers need steps as short as the height of the flattest tet.
void note_nearly_flat(const TetMesh& mesh, Notes& notes) {
    constexpr double kNearlyFlat = 1e-3;
    std::size_t count = 0, worst = 0;
    double least = 1.0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const glm::uvec4& tet = mesh.tets[t];
        const double round = roundness(
            {mesh.positions[tet[0]], mesh.positions[tet[1]], mesh.positions[tet[2]], mesh.positions[tet[3]]});
        count += round < kNearlyFlat ? 1 : 0;
        if (round < least) {
            least = round;
            worst = t;
        }
    }
    if (count == 0) return;
    notes.push_back(
        fmt::format("nearly flat tets, which shorten the steps of explicit solvers: {} (the flattest is tet "
                    "{}, with {:.1g} of "
                    "the volume of a regular one)",
                    count, worst + 1, least));
}

// A face of one of its tets.
struct Side {
    std::array<std::uint32_t, 3> nodes;  // ascending
    bool is_flipped;                     // an odd permutation, relative to the orientation seen from outside
    std::uint32_t tet;
};

std::vector<Side> sorted_sides(const TetMesh& mesh) {
    constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};  // outward
    std::vector<Side> sides;
    sides.reserve(4 * mesh.tets.size());
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
        for (const auto& face : kFaces) {
            Side side{{mesh.tets[t][face[0]], mesh.tets[t][face[1]], mesh.tets[t][face[2]]}, false, t};
            const auto order = [&](int a, int b) {
                if (side.nodes[a] < side.nodes[b]) return;
                std::swap(side.nodes[a], side.nodes[b]);
                side.is_flipped = !side.is_flipped;
            };
            order(0, 1);
            order(1, 2);
            order(0, 1);
            sides.push_back(side);
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.tet < b.tet;
    });
    return sides;
}

void note_overlaps(const TetMesh& mesh, Notes& notes) {
    const std::vector<Side> sides = sorted_sides(mesh);
    std::size_t crowded = 0, overlapping = 0;
    const Side* first = nullptr;  // of those that overlap
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        for (end = begin + 1; end < sides.size() && sides[end].nodes == sides[begin].nodes;) ++end;
        crowded += end - begin > 2 ? 1 : 0;
        // Neighbours see their common face from opposite sides.
        if (end - begin != 2 || sides[begin].is_flipped != sides[begin + 1].is_flipped) continue;
        ++overlapping;
        if (first == nullptr) first = &sides[begin];
    }
    if (crowded > 0) notes.push_back(fmt::format("faces of more than two tets: {}", crowded));
    if (overlapping > 0) {
        notes.push_back(
            fmt::format("tets that overlap a neighbour, as in a tangled mesh: {} (the first is tets {} "
                        "and {})",
                        counted(overlapping, "pair"), first[0].tet + 1, first[1].tet + 1));
    }
}

}  // namespace

double roundness(const std::array<glm::dvec3, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            longest = std::max(longest, glm::distance(corners[i], corners[j]));
    }
    const double volume = std::abs(glm::dot(glm::cross(b - a, c - a), d - a)) / 6.0;
    return 6.0 * std::sqrt(2.0) * volume / (longest * longest * longest);
}

void check_tets(const TetMesh& mesh, Notes& notes) {
    note_nearly_flat(mesh, notes);
    note_overlaps(mesh, notes);
}

}  // namespace gelatin
