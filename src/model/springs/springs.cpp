#include "model/springs/springs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "mesh/topology.h"
#include "model/springs/links.h"

namespace gelatin {
namespace {

// Shares of the continuum's stiffness before they are scaled to the kinds that a material has. The ratio 3 :
// 2 between edges and links keeps irregular nets closest to isotropy.
constexpr double kStructuralShare = 3.0;
constexpr double kShearShare = 2.0;
constexpr double kFlexShare = 1.0;

constexpr double kStraightestCosine = 0.8660254;  // 30 degrees

// The neighbour of `middle` that continues the line from `node` most nearly straight, or `node` if none does.
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
    std::vector<Link> links = surface_links(mesh, mean_tet_volume);
    std::vector<bool> on_surface(mesh.positions.size(), false);
    for (const glm::uvec3& face : mesh.faces) {
        for (int k = 0; k < 3; ++k) on_surface[face[k]] = true;
    }
    for (std::uint32_t node = 0; node < mesh.positions.size(); ++node) {
        for (const std::uint32_t middle : graph.row(node)) {
            if (on_surface[middle]) continue;
            const std::uint32_t end = straight_continuation(mesh, graph, node, middle);
            if (end != node) links.push_back({{std::min(node, end), std::max(node, end)}, mean_tet_volume});
        }
    }
    sort_and_drop_doubles(links);
    return links;
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
    const std::vector<double> volumes = tet_volumes(mesh);
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);

    std::vector<std::pair<std::vector<Link>, double>> shares;
    std::vector<Link> taken;
    const auto add_kind = [&](const std::vector<Link>& links, double share) {
        shares.emplace_back(without(links, taken), share);
        std::vector<Link> both;
        std::merge(taken.begin(), taken.end(), shares.back().first.begin(), shares.back().first.end(),
                   std::back_inserter(both), ByNodes{});
        taken = std::move(both);
    };
    if (kinds.structural) add_kind(edge_links(mesh, volumes), kStructuralShare);
    if (kinds.shear) add_kind(face_links(mesh, volumes), kShearShare);
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
