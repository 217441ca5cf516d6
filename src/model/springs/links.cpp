#include "model/springs/links.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesh/topology.h"

namespace gelatin {
namespace {

bool same_nodes(const Link& a, const Link& b) {
    return a.nodes == b.nodes;
}

Link make_link(std::uint32_t a, std::uint32_t b, double volume) {
    return {{std::min(a, b), std::max(a, b)}, volume};
}

// Adds up the volumes of equal pairs.
std::vector<Link> merged(std::vector<Link> links) {
    std::sort(links.begin(), links.end(), ByNodes{});
    std::size_t kept = 0;
    for (const Link& link : links) {
        if (kept > 0 && same_nodes(links[kept - 1], link)) {
            links[kept - 1].volume += link.volume;
        } else {
            links[kept++] = link;
        }
    }
    links.resize(kept);
    return links;
}

}  // namespace

std::vector<double> tet_volumes(const TetMesh& mesh) {
    std::vector<double> volumes;
    volumes.reserve(mesh.tets.size());
    for (const glm::uvec4& tet : mesh.tets) volumes.push_back(tet_volume(mesh, tet));
    return volumes;
}

std::vector<Link> edge_links(const TetMesh& mesh, const std::vector<double>& volumes) {
    std::vector<Link> links;
    links.reserve(mesh.tets.size() * 6);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (int a = 0; a < 4; ++a) {
            for (int b = a + 1; b < 4; ++b)
                links.push_back(make_link(mesh.tets[t][a], mesh.tets[t][b], volumes[t]));
        }
    }
    return merged(std::move(links));
}

std::vector<Link> face_links(const TetMesh& mesh, const std::vector<double>& volumes) {
    std::vector<Link> links;
    for (const InnerFace& face : inner_faces(mesh.tets)) {
        links.push_back(
            make_link(face.corners[0], face.corners[1], volumes[face.tets[0]] + volumes[face.tets[1]]));
    }
    return merged(std::move(links));
}

std::vector<Link> surface_links(const TetMesh& mesh, double volume) {
    std::vector<Link> links;
    for (const SurfaceEdge& edge : surface_edges(mesh.faces)) {
        if (edge.corners[0] != edge.corners[1]) {
            links.push_back(make_link(edge.corners[0], edge.corners[1], volume));
        }
    }
    return links;
}

void sort_and_drop_doubles(std::vector<Link>& links) {
    std::sort(links.begin(), links.end(), ByNodes{});
    links.erase(std::unique(links.begin(), links.end(), same_nodes), links.end());
}

std::vector<Link> without(const std::vector<Link>& links, const std::vector<Link>& taken) {
    std::vector<Link> rest;
    std::set_difference(links.begin(), links.end(), taken.begin(), taken.end(), std::back_inserter(rest),
                        ByNodes{});
    return rest;
}

}  // namespace gelatin
