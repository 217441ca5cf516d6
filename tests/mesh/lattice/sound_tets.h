#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"
#include "mesh/tet_quality.h"
#include "mesh/topology.h"

namespace gelatin {

/// The smallest angle between two faces of a tet [degrees].
inline double least_dihedral_angle(const TetMesh& mesh) {
    double least = 180.0;
    for (const glm::uvec4& t : mesh.tets) {
        const auto angles = dihedral_angles(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]],
                                            mesh.positions[t[3]]);
        least = std::min(least, *std::min_element(angles.begin(), angles.end()) * 180.0 / std::numbers::pi);
    }
    return least;
}

/// Is each edge of the faces in two of them, once in each direction, and the faces around each node one fan?
inline bool is_manifold(const std::vector<glm::uvec3>& faces) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> next;  // around each node
    for (const glm::uvec3& f : faces) {
        for (int k = 0; k < 3; ++k) {
            if (++edges[{f[k], f[(k + 1) % 3]}] > 1) return false;
            next[f[k]][f[(k + 1) % 3]] = f[(k + 2) % 3];
        }
    }
    for (const auto& [edge, count] : edges) {
        if (!edges.contains({edge.second, edge.first})) return false;
    }
    for (const auto& [node, ring] : next) {
        std::size_t length = 0;
        std::uint32_t at = ring.begin()->first;
        do {
            at = ring.at(at);
            ++length;
        } while (at != ring.begin()->first && length <= ring.size());
        if (length != ring.size()) return false;
    }
    return true;
}

/// What every result must be: tets of positive volume that share whole faces, each node in one at least and
/// none twice at one place, a boundary that is a closed manifold.
inline void expect_sound(const TetMesh& mesh) {
    ASSERT_FALSE(mesh.tets.empty());
    std::vector<bool> is_used(mesh.positions.size(), false);
    for (const glm::uvec4& tet : mesh.tets) {
        ASSERT_GT(tet_volume(mesh, tet), 0.0);
        for (int k = 0; k < 4; ++k) is_used.at(tet[k]) = true;
    }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
    std::vector<std::array<double, 3>> places;
    for (const glm::dvec3& p : mesh.positions) {
        ASSERT_TRUE(std::isfinite(p.x + p.y + p.z));
        places.push_back({p.x, p.y, p.z});
    }
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << "nodes at the same place";
    EXPECT_EQ(mesh.faces, boundary_faces(mesh.tets));
    EXPECT_TRUE(is_manifold(mesh.faces));
    // A face of three tets would be missing here: each tet has four sides.
    EXPECT_EQ(mesh.faces.size() + 2 * inner_faces(mesh.tets).size(), 4 * mesh.tets.size());
}

}  // namespace gelatin
