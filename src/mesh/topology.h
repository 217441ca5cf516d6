#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// A graph in compressed rows: neighbours of n are targets[starts[n]] .. targets[starts[n + 1]].
struct Graph {
    std::vector<std::uint32_t> starts;   ///< shape [nodes + 1]
    std::vector<std::uint32_t> targets;  ///< ascending in each row

    std::span<const std::uint32_t> row(std::uint32_t n) const {
        return {targets.data() + starts[n], targets.data() + starts[n + 1]};
    }
    std::uint32_t degree(std::uint32_t n) const { return starts[n + 1] - starts[n]; }
    bool connects(std::uint32_t a, std::uint32_t b) const;
};

/// Signed volume of a tet [m^3], positive for the winding of TetMesh.
double tet_volume(const TetMesh& mesh, const glm::uvec4& tet);
/// Of all tets [m^3].
double total_volume(const TetMesh& mesh);

/// Removes the tets, and their attributes, for which `keep` [tets] is false. Returns how many.
std::size_t keep_tets(TetMesh& mesh, const std::vector<bool>& keep);

/// The edges of the tets, each once, first node smaller, in ascending order.
std::vector<glm::uvec2> tet_edges(std::span<const glm::uvec4> tets);

/// The graph whose edges are `edges`.
Graph make_graph(std::size_t node_count, std::span<const glm::uvec2> edges);

/// Triangles that belong to one tet only, counter-clockwise as seen from outside.
std::vector<glm::uvec3> boundary_faces(std::span<const glm::uvec4> tets);

/// Two tets that share a face, and the corner of each opposite to it.
struct InnerFace {
    std::array<std::uint32_t, 2> tets, corners;
};
std::vector<InnerFace> inner_faces(std::span<const glm::uvec4> tets);

/// Two triangles that share an edge, and the corner of each opposite to it.
struct SurfaceEdge {
    glm::uvec2 nodes;
    std::array<std::uint32_t, 2> faces, corners;
};
/// Edges of exactly two faces.
std::vector<SurfaceEdge> surface_edges(std::span<const glm::uvec3> faces);

/// An order of nodes for locality: reverse Cuthill-McKee from a peripheral node of each component, then a
/// stable sort by degree within windows of `window` nodes. order[new] = old.
std::vector<std::uint32_t> locality_order(const Graph& graph, std::uint32_t window);

}  // namespace gelatin
