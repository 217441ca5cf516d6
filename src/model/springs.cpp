#include "model/springs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "mesh/topology.h"

namespace gelatin {
namespace {

// Shares of the continuum's stiffness before they are scaled to the kinds that a material has; 3 : 2 between
// edges and links is what keeps irregular nets closest to isotropy.
constexpr double kStructuralShare = 3.0;
constexpr double kShearShare = 2.0;
constexpr double kFlexShare = 1.0;

constexpr double kStraightestCosine = 0.8660254;  // 30 degrees

// A pair of nodes and the volume of material that stands behind it [m^3].
struct Link {
    glm::uvec2 nodes;
    double volume;
};

bool by_nodes(const Link& a, const Link& b) {
    return a.nodes.x != b.nodes.x ? a.nodes.x < b.nodes.x : a.nodes.y < b.nodes.y;
}
bool same_nodes(const Link& a, const Link& b) {
    return a.nodes == b.nodes;
}

Link make_link(std::uint32_t a, std::uint32_t b, double volume) {
    return {{std::min(a, b), std::max(a, b)}, volume};
}

// Adds up the volumes of equal pairs.
std::vector<Link> merged(std::vector<Link> links) {
    std::sort(links.begin(), links.end(), by_nodes);
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

std::vector<Link> structural_links(const TetMesh& mesh, const std::vector<double>& volumes) {
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

std::vector<Link> shear_links(const TetMesh& mesh, const std::vector<double>& volumes) {
    std::vector<Link> links;
    for (const InnerFace& face : inner_faces(mesh.tets)) {
        links.push_back(
            make_link(face.corners[0], face.corners[1], volumes[face.tets[0]] + volumes[face.tets[1]]));
    }
    return merged(std::move(links));
}

// From `node` over `middle`: the neighbour of `middle` that goes on the straightest, or `node` if none is
// straight.
std::uint32_t straight_continuation(const TetMesh& mesh, const Graph& graph, std::uint32_t node,
                                    std::uint32_t middle) {
    const glm::dvec3 along = glm::normalize(mesh.positions[middle] - mesh.positions[node]);
    double best_cosine = kStraightestCosine;
    std::uint32_t best = node;
    for (const std::uint32_t end : graph.row(middle)) {
        if (end == node || graph.connects(node, end)) continue;
        const double cosine = glm::dot(along, glm::normalize(mesh.positions[end] - mesh.positions[middle]));
        if (cosine > best_cosine) {
            best_cosine = cosine;
            best = end;
        }
    }
    return best;
}

std::vector<Link> flex_links(const TetMesh& mesh, const Graph& graph, double mean_tet_volume) {
    std::vector<Link> links;
    for (const SurfaceEdge& edge : surface_edges(mesh.faces)) {
        if (edge.corners[0] != edge.corners[1]) {
            links.push_back(make_link(edge.corners[0], edge.corners[1], mean_tet_volume));
        }
    }
    std::vector<bool> on_surface(mesh.positions.size(), false);
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) on_surface[face[k]] = true;
    }
    for (std::uint32_t node = 0; node < mesh.positions.size(); ++node) {
        for (const std::uint32_t middle : graph.row(node)) {
            if (on_surface[middle]) continue;
            const std::uint32_t end = straight_continuation(mesh, graph, node, middle);
            if (end != node) links.push_back(make_link(node, end, mean_tet_volume));
        }
    }
    std::sort(links.begin(), links.end(), by_nodes);
    links.erase(std::unique(links.begin(), links.end(), same_nodes), links.end());
    return links;
}

std::vector<Link> without(const std::vector<Link>& links, const std::vector<Link>& taken) {
    std::vector<Link> rest;
    std::set_difference(links.begin(), links.end(), taken.begin(), taken.end(), std::back_inserter(rest),
                        by_nodes);
    return rest;
}

// k = c V_s / l^2 with c such that sum(k l^2) over the kind is `sum_k_l2` [N m]; then sum(k l^2) = c
// sum(V_s).
void append_springs(const TetMesh& mesh, const std::vector<Link>& links, double sum_k_l2,
                    std::vector<Spring>& springs) {
    double total_volume = 0.0;
    for (const Link& link : links) total_volume += link.volume;
    for (const Link& link : links) {
        const double length = glm::distance(mesh.positions[link.nodes.x], mesh.positions[link.nodes.y]);
        const double stiffness = sum_k_l2 * link.volume / (total_volume * length * length);
        springs.push_back(
            {link.nodes.x, link.nodes.y, static_cast<float>(length), static_cast<float>(stiffness)});
    }
}

}  // namespace

std::vector<Spring> make_springs(const TetMesh& mesh, const SpringKinds& kinds, double youngs_modulus) {
    std::vector<double> volumes;
    volumes.reserve(mesh.tets.size());
    for (const glm::uvec4& tet : mesh.tets) volumes.push_back(tet_volume(mesh, tet));
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);

    std::vector<std::pair<std::vector<Link>, double>> shares;
    std::vector<Link> taken;
    const auto add_kind = [&](const std::vector<Link>& links, double share) {
        shares.emplace_back(without(links, taken), share);
        std::vector<Link> both;
        std::merge(taken.begin(), taken.end(), shares.back().first.begin(), shares.back().first.end(),
                   std::back_inserter(both), by_nodes);
        taken = std::move(both);
    };
    if (kinds.structural) add_kind(structural_links(mesh, volumes), kStructuralShare);
    if (kinds.shear) add_kind(shear_links(mesh, volumes), kShearShare);
    if (kinds.flex) {
        const Graph graph = make_graph(mesh.positions.size(), tet_edges(mesh.tets));
        add_kind(flex_links(mesh, graph, volume / static_cast<double>(mesh.tets.size())), kFlexShare);
    }

    double share_sum = 0.0;
    for (const auto& [links, share] : shares) share_sum += links.empty() ? 0.0 : share;
    std::vector<Spring> springs;
    for (const auto& [links, share] : shares) {
        append_springs(mesh, links, 6.0 * youngs_modulus * volume * share / share_sum, springs);
    }
    std::sort(springs.begin(), springs.end(),
              [](const Spring& a, const Spring& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    return springs;
}

}  // namespace gelatin
