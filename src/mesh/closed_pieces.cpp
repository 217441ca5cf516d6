#include "mesh/closed_pieces.h"

#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "core/disjoint_sets.h"
#include "mesh/edge_uses.h"

namespace gelatin {

std::vector<std::vector<std::uint32_t>> find_closed_pieces(std::span<const glm::uvec3> faces) {
    DisjointSets sets(faces.size());
    std::vector<std::uint32_t> open;
    const std::vector<EdgeUse> uses = sorted_edge_uses(faces);
    for_each_edge(std::span<const EdgeUse>(uses), [&](std::span<const EdgeUse> edge) {
        if (edge.size() == 2)
            sets.unite(edge[0].face, edge[1].face);
        else
            for (const EdgeUse& use : edge) open.push_back(use.face);
    });
    std::map<std::uint32_t, std::vector<std::uint32_t>> pieces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) pieces[sets.least(f)].push_back(f);
    for (const std::uint32_t f : open) pieces.erase(sets.least(f));
    std::vector<std::vector<std::uint32_t>> result;
    for (auto& [first, piece] : pieces) result.push_back(std::move(piece));
    return result;
}

std::vector<std::vector<glm::uvec3>> find_hollows(const TetMesh& mesh) {
    std::vector<std::vector<glm::uvec3>> hollows;
    for (const std::vector<std::uint32_t>& piece : find_closed_pieces(mesh.faces)) {
        const glm::dvec3 origin = mesh.positions[mesh.faces[piece.front()].x];
        const auto at = [&](std::uint32_t n) { return mesh.positions[n] - origin; };
        double volume = 0.0;
        std::vector<glm::uvec3> faces;
        for (const std::uint32_t f : piece) {
            const glm::uvec3& face = mesh.faces[f];
            volume += glm::dot(at(face.x), glm::cross(at(face.y), at(face.z)));
            faces.emplace_back(face.x, face.z, face.y);
        }
        if (volume < 0.0) hollows.push_back(std::move(faces));
    }
    return hollows;
}

}  // namespace gelatin
