#include "mesh/lattice/separate_touching.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/disjoint_sets.h"
#include "mesh/tet_quality.h"
#include "mesh/topology.h"

namespace gelatin::lattice {
namespace {

using NodePair = std::pair<std::uint32_t, std::uint32_t>;

std::uint32_t corner_of(const glm::uvec4& tet, std::uint32_t node) {
    return tet[0] == node ? 0 : tet[1] == node ? 1 : tet[2] == node ? 2 : 3;
}

double worst_of(const TetMesh& mesh, const glm::uvec4& tet) {
    return worst_sine(mesh.positions[tet[0]], mesh.positions[tet[1]], mesh.positions[tet[2]],
                      mesh.positions[tet[3]]);
}

// Towards the middle of its tets, as far as these keep half of their quality.
void move_inwards(TetMesh& mesh, std::uint32_t node, const std::vector<std::uint32_t>& tets) {
    glm::dvec3 middle(0.0);
    double before = 1.0;
    for (const std::uint32_t t : tets) {
        for (int k = 0; k < 4; ++k)
            middle += mesh.positions[mesh.tets[t][k]] / (4.0 * static_cast<double>(tets.size()));
        before = std::min(before, worst_of(mesh, mesh.tets[t]));
    }
    const glm::dvec3 start = mesh.positions[node];
    for (double part = 0.1; part > 1e-4; part *= 0.5) {
        mesh.positions[node] = start + part * (middle - start);
        const bool keeps = std::all_of(tets.begin(), tets.end(), [&](std::uint32_t t) {
            return worst_of(mesh, mesh.tets[t]) > 0.5 * before;
        });
        if (keeps) return;
    }
}

// A node for each set of tets around it that are joined by faces with this node.
void divide_nodes(TetMesh& mesh) {
    DisjointSets corners(4 * mesh.tets.size());
    const auto corner = [&](std::uint32_t tet, std::uint32_t node) {
        return 4 * tet + corner_of(mesh.tets[tet], node);
    };
    for (const InnerFace& face : inner_faces(mesh.tets)) {
        const auto [a, b] = face.tets;
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t node = mesh.tets[a][k];
            if (node != face.corners[0]) corners.unite(corner(a, node), corner(b, node));
        }
    }
    constexpr std::uint32_t kNone = ~0u;
    std::vector<std::uint32_t> first(mesh.positions.size(), kNone);  // the set that keeps the node
    std::map<std::uint32_t, std::vector<std::uint32_t>> others;      // sets that do not, and their corners
    for (std::uint32_t c = 0; c < 4 * mesh.tets.size(); ++c) {
        std::uint32_t& keeper = first[mesh.tets[c / 4][static_cast<int>(c % 4)]];
        const std::uint32_t set = corners.least(c);
        if (keeper == kNone) keeper = set;
        if (keeper != set) others[set].push_back(c);
    }
    for (const auto& [set, members] : others) {
        const auto node = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(mesh.positions[mesh.tets[set / 4][static_cast<int>(set % 4)]]);
        std::vector<std::uint32_t> tets;
        for (const std::uint32_t c : members) {
            mesh.tets[c / 4][static_cast<int>(c % 4)] = node;
            tets.push_back(c / 4);
        }
        move_inwards(mesh, node, tets);
    }
}

// Edges with more than two boundary faces.
std::vector<NodePair> find_crowded_edges(const TetMesh& mesh) {
    std::vector<NodePair> edges, crowded;
    for (const glm::uvec3& face : boundary_faces(mesh.tets)) {
        for (int k = 0; k < 3; ++k) edges.push_back(std::minmax(face[k], face[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        if (end - begin > 2) crowded.push_back(edges[begin]);
    }
    return crowded;
}

// The tets around an edge, in sets that are joined by faces with this edge.
std::vector<std::vector<std::uint32_t>> fans_around(const TetMesh& mesh,
                                                    const std::vector<std::uint32_t>& tets,
                                                    const NodePair& edge) {
    DisjointSets joined(tets.size());
    const auto shares_face = [&](const glm::uvec4& a, const glm::uvec4& b) {
        for (int i = 0; i < 4; ++i) {
            if (a[i] == edge.first || a[i] == edge.second) continue;
            for (int j = 0; j < 4; ++j) {
                if (a[i] == b[j]) return true;
            }
        }
        return false;
    };
    for (std::uint32_t i = 0; i < tets.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (shares_face(mesh.tets[tets[i]], mesh.tets[tets[j]])) joined.unite(i, j);
        }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> fans;
    for (std::uint32_t i = 0; i < tets.size(); ++i) fans[joined.least(i)].push_back(tets[i]);
    std::vector<std::vector<std::uint32_t>> sorted;
    for (auto& [set, fan] : fans) sorted.push_back(std::move(fan));
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return sorted;
}

// All fans of tets around crowded edges but the largest.
bool remove_fans(TetMesh& mesh) {
    const std::vector<NodePair> crowded = find_crowded_edges(mesh);
    if (crowded.empty()) return false;
    std::map<NodePair, std::vector<std::uint32_t>> around;
    for (const NodePair& edge : crowded) around[edge];
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            for (int j = i + 1; j < 4; ++j) {
                const auto found = around.find(std::minmax(mesh.tets[t][i], mesh.tets[t][j]));
                if (found != around.end()) found->second.push_back(t);
            }
        }
    }
    std::vector<bool> keep(mesh.tets.size(), true);
    for (const auto& [edge, tets] : around) {
        const auto fans = fans_around(mesh, tets, edge);
        for (std::size_t f = 1; f < fans.size(); ++f) {
            for (const std::uint32_t t : fans[f]) keep[t] = false;
        }
    }
    keep_tets(mesh, keep);
    return true;
}

// The boundary faces around a node, in sets that are joined by edges with this node.
std::map<std::uint32_t, std::vector<glm::uvec3>> umbrellas_of(const std::vector<glm::uvec3>& faces,
                                                              std::uint32_t node) {
    DisjointSets joined(faces.size());
    const auto shares_edge = [&](const glm::uvec3& a, const glm::uvec3& b) {
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                if (a[i] == b[j] && a[i] != node) return true;
            }
        }
        return false;
    };
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (shares_edge(faces[i], faces[j])) joined.unite(i, j);
        }
    }
    std::map<std::uint32_t, std::vector<glm::uvec3>> umbrellas;
    for (std::uint32_t i = 0; i < faces.size(); ++i) umbrellas[joined.least(i)].push_back(faces[i]);
    return umbrellas;
}

bool has_corners(const glm::uvec4& tet, const glm::uvec3& face) {
    int count = 0;
    for (int i = 0; i < 4; ++i) count += tet[i] == face[0] || tet[i] == face[1] || tet[i] == face[2] ? 1 : 0;
    return count == 3;
}

// The shortest chain of tets around `node`, joined by faces with it, from one of its umbrellas to another.
std::vector<std::uint32_t> chain_between(const TetMesh& mesh, const std::vector<std::uint32_t>& tets,
                                         const std::map<std::uint32_t, std::vector<glm::uvec3>>& umbrellas) {
    const auto touches = [&](std::uint32_t t, const std::vector<glm::uvec3>& faces) {
        return std::any_of(faces.begin(), faces.end(),
                           [&](const glm::uvec3& face) { return has_corners(mesh.tets[t], face); });
    };
    const auto are_neighbours = [&](const glm::uvec4& a, const glm::uvec4& b) {
        int common = 0;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) common += a[i] == b[j] ? 1 : 0;
        }
        return common == 3;
    };
    const auto& start = umbrellas.begin()->second;
    std::map<std::uint32_t, std::uint32_t> came_from;
    std::vector<std::uint32_t> queue;
    for (const std::uint32_t t : tets) {
        if (!touches(t, start)) continue;
        came_from[t] = t;
        queue.push_back(t);
    }
    for (std::size_t k = 0; k < queue.size(); ++k) {
        const bool arrives =
            std::any_of(std::next(umbrellas.begin()), umbrellas.end(),
                        [&](const auto& umbrella) { return touches(queue[k], umbrella.second); });
        if (arrives) {
            std::vector<std::uint32_t> chain = {queue[k]};
            while (came_from[chain.back()] != chain.back()) chain.push_back(came_from[chain.back()]);
            return chain;
        }
        for (const std::uint32_t t : tets) {
            if (came_from.contains(t) || !are_neighbours(mesh.tets[t], mesh.tets[queue[k]])) continue;
            came_from[t] = queue[k];
            queue.push_back(t);
        }
    }
    return {};
}

// Nodes where the outside is narrowed to a point: a chain of tets is removed from one side to the other.
bool open_narrows(TetMesh& mesh) {
    std::vector<std::vector<glm::uvec3>> faces(mesh.positions.size());
    for (const glm::uvec3& face : boundary_faces(mesh.tets)) {
        for (int k = 0; k < 3; ++k) faces[face[k]].push_back(face);
    }
    std::map<std::uint32_t, std::map<std::uint32_t, std::vector<glm::uvec3>>> narrow;  // umbrellas by node
    for (std::uint32_t node = 0; node < faces.size(); ++node) {
        if (faces[node].empty()) continue;
        auto umbrellas = umbrellas_of(faces[node], node);
        if (umbrellas.size() > 1) narrow.emplace(node, std::move(umbrellas));
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> around;
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
        for (int k = 0; k < 4; ++k) {
            if (narrow.contains(mesh.tets[t][k])) around[mesh.tets[t][k]].push_back(t);
        }
    }
    std::vector<bool> keep(mesh.tets.size(), true);
    for (const auto& [node, umbrellas] : narrow) {
        for (const std::uint32_t t : chain_between(mesh, around[node], umbrellas)) keep[t] = false;
    }
    return keep_tets(mesh, keep) > 0;
}

}  // namespace

void remove_unused_nodes(TetMesh& mesh) {
    constexpr std::uint32_t kUnused = ~0u;
    std::vector<std::uint32_t> new_index(mesh.positions.size(), kUnused);
    for (const glm::uvec4& tet : mesh.tets) {
        for (int k = 0; k < 4; ++k) new_index[tet[k]] = 0;
    }
    std::uint32_t count = 0;
    for (std::size_t node = 0; node < new_index.size(); ++node) {
        if (new_index[node] == kUnused) continue;
        mesh.positions[count] = mesh.positions[node];
        new_index[node] = count++;
    }
    mesh.positions.resize(count);
    for (glm::uvec4& tet : mesh.tets) {
        for (int k = 0; k < 4; ++k) tet[k] = new_index[tet[k]];
    }
}

// Each round removes tets, so that the rounds end.
void separate_touching(TetMesh& mesh) {
    do {
        divide_nodes(mesh);
    } while (remove_fans(mesh) || open_narrows(mesh));
    remove_unused_nodes(mesh);
    mesh.faces = boundary_faces(mesh.tets);
}

}  // namespace gelatin::lattice
