#include "mesh/lattice/surface_pieces.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/disjoint_sets.h"

namespace gelatin::lattice {

SurfacePieces find_pieces(const SurfaceMesh& surface) {
    DisjointSets vertices(surface.positions.size());
    for (const glm::uvec3& face : surface.faces) {
        vertices.unite(face[0], face[1]);
        vertices.unite(face[1], face[2]);
    }
    struct Sum {
        glm::dvec3 origin, normal{0.0};
        double area = 0.0, volume = 0.0;
    };
    std::vector<Sum> sums;
    std::vector<std::uint32_t> piece_of_vertex(surface.positions.size(), ~0u);
    SurfacePieces pieces;
    for (const glm::uvec3& face : surface.faces) {
        std::uint32_t& piece = piece_of_vertex[vertices.least(face[0])];
        const glm::dvec3 &a = surface.positions[face[0]], &b = surface.positions[face[1]],
                         &c = surface.positions[face[2]];
        if (piece == ~0u) {
            piece = static_cast<std::uint32_t>(sums.size());
            sums.push_back({a});
        }
        pieces.of_face.push_back(piece);
        Sum& sum = sums[piece];
        const glm::dvec3 normal = 0.5 * glm::cross(b - a, c - a);
        sum.normal += normal;
        sum.area += glm::length(normal);
        sum.volume += glm::dot(normal, a - sum.origin) / 3.0;
    }
    for (const Sum& sum : sums) {
        const bool is_closed = glm::length(sum.normal) < 1e-6 * sum.area;
        pieces.thickness.push_back(is_closed ? 6.0 * std::abs(sum.volume) / sum.area : 0.0);
    }
    return pieces;
}

}  // namespace gelatin::lattice
