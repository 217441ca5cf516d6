#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// A pair of nodes that a spring may join, the first smaller, and the volume of material that it represents
/// [m^3].
struct Link {
    glm::uvec2 nodes;
    double volume;
};

/// The order that lists of links are kept in.
struct ByNodes {
    bool operator()(const Link& a, const Link& b) const {
        return a.nodes.x != b.nodes.x ? a.nodes.x < b.nodes.x : a.nodes.y < b.nodes.y;
    }
};

/// The volume of each tet [m^3].
std::vector<double> tet_volumes(const TetMesh& mesh);

/// The edges of the tets, each once, with the volume of the tets around it.
std::vector<Link> edge_links(const TetMesh& mesh, const std::vector<double>& volumes);

/// The opposite corners of two tets that share a face, each pair once, with the volume of such tets.
std::vector<Link> face_links(const TetMesh& mesh, const std::vector<double>& volumes);

/// The opposite corners of two boundary faces that share an edge, in no order, all with `volume`.
std::vector<Link> surface_links(const TetMesh& mesh, double volume);

/// Sorts the links, and removes all but the first of those that join the same nodes.
void sort_and_drop_doubles(std::vector<Link>& links);

/// The sorted `links` except those whose nodes are joined by one of the sorted `taken`.
std::vector<Link> without(const std::vector<Link>& links, const std::vector<Link>& taken);

}  // namespace gelatin
