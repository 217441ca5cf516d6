#include "model/springs/fit_springs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numeric>

#include "mesh/topology.h"
#include "model/springs/elastic_response.h"
#include "model/springs/moment_fit.h"

namespace gelatin {
namespace {

constexpr double kLinkShare = 0.4;  // share of the continuum's stiffness before the fit; edges have the rest
constexpr double kShortest =
    0.3;  // relative to the cube root of the volume that it represents; shorter links are omitted
constexpr double kYoungsOverShear = 1.0 / kShearOverYoungs;

// Springs before and during the fit, with their stiffness for a shear modulus of 1 [m].
struct Springs {
    std::vector<Link> links;
    std::vector<double> stiffness;
};

double length_of(const TetMesh& mesh, const Link& link) {
    return glm::distance(mesh.positions[link.nodes.x], mesh.positions[link.nodes.y]);
}

// Between nodes that nearly coincide a spring would be very stiff, or have no direction.
void drop_short_links(const TetMesh& mesh, std::vector<Link>& links) {
    const auto is_short = [&](const Link& link) {
        return !(length_of(mesh, link) > kShortest * std::cbrt(link.volume));
    };
    links.erase(std::remove_if(links.begin(), links.end(), is_short), links.end());
}

double median_volume(const std::vector<Link>& links) {
    std::vector<double> volumes;
    for (const Link& link : links) volumes.push_back(link.volume);
    const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
    std::nth_element(volumes.begin(), middle, volumes.end());
    return *middle;
}

// Corners opposite inner faces, and across surface edges; none of `edges`.
std::vector<Link> links_beside(const TetMesh& mesh, const std::vector<double>& volumes,
                               const std::vector<Link>& edges) {
    const std::vector<Link> inner = without(face_links(mesh, volumes), edges);
    if (inner.empty()) return {};
    std::vector<Link> across = surface_links(mesh, 0.5 * median_volume(inner));
    sort_and_drop_doubles(across);
    const std::vector<Link> outer = without(without(across, edges), inner);
    std::vector<Link> links;
    std::merge(inner.begin(), inner.end(), outer.begin(), outer.end(), std::back_inserter(links), ByNodes{});
    drop_short_links(mesh, links);
    return links;
}

// Each spring's share of `energy`, the sum of k l^2, is proportional to the volume that it represents. The
// length of a link is increased by that volume's: the two tets of a link across a sliver's face nearly
// coincide, and so do its ends.
void append_start(const TetMesh& mesh, const std::vector<Link>& links, double energy, double bluntness,
                  Springs& springs) {
    double sum = 0.0;
    for (const Link& link : links) sum += link.volume;
    for (const Link& link : links) {
        const double length = length_of(mesh, link);
        const double size = std::cbrt(link.volume);
        springs.links.push_back(link);
        springs.stiffness.push_back(energy * link.volume / sum / (length * length + bluntness * size * size));
    }
}

// Van Gelder's stiffnesses, distributed over edges and links; in ascending order of nodes.
Springs start_of_fit(const TetMesh& mesh, const std::vector<double>& volumes, double volume) {
    const std::vector<Link> edges = edge_links(mesh, volumes);
    const std::vector<Link> links = links_beside(mesh, volumes, edges);
    const double link_share = links.empty() ? 0.0 : kLinkShare;
    Springs both;
    append_start(mesh, edges, 15.0 * volume * (1.0 - link_share), 0.0, both);
    append_start(mesh, links, 15.0 * volume * link_share, 1.0, both);

    std::vector<std::size_t> order(both.links.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return ByNodes{}(both.links[a], both.links[b]); });
    Springs sorted;
    for (const std::size_t s : order) {
        sorted.links.push_back(both.links[s]);
        sorted.stiffness.push_back(both.stiffness[s]);
    }
    return sorted;
}

MomentTargets make_targets(const TetMesh& mesh, const std::vector<double>& volumes) {
    MomentTargets targets{std::vector<double>(mesh.positions.size(), 0.0), boundary_areas(mesh)};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (int k = 0; k < 4; ++k) targets.node_volumes[mesh.tets[t][k]] += 0.25 * volumes[t];
    }
    return targets;
}

// sum k l^2, which is 15 V if the energy of dilation is the continuum's.
double dilation_energy(const RestNet& net, const std::vector<double>& stiffness) {
    double sum = 0.0;
    for (std::size_t s = 0; s < stiffness.size(); ++s) sum += stiffness[s] * net.lengths[s] * net.lengths[s];
    return sum;
}

// The factor for all stiffnesses that gives 1 / E the right mean over the three axes. A mean over all
// directions would make bars too stiff. They are mostly stretched along an axis, and on coarse meshes the
// surface layer is softer in shear than in tension, which affects the other directions.
double missing_factor(const ElasticResponse& response) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) sum += response.compliance(axis, axis);
    const double factor = kYoungsOverShear * sum / 3.0;
    return std::isfinite(factor) && factor > 0.0 ? factor : 1.0;
}

}  // namespace

FittedSprings fit_springs(const TetMesh& mesh) {
    const std::vector<double> volumes = tet_volumes(mesh);
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    Springs springs = start_of_fit(mesh, volumes, volume);
    const RestNet net = make_rest_net(mesh, springs.links);

    const std::vector<double> fit = fit_to_moments(net, springs.stiffness, make_targets(mesh, volumes));
    for (std::size_t s = 0; s < fit.size(); ++s) springs.stiffness[s] *= fit[s];
    const double isotropic = 15.0 * volume / dilation_energy(net, springs.stiffness);
    for (double& k : springs.stiffness) k *= isotropic;

    const ElasticResponse response = measure_response(mesh, net, springs.stiffness, kYoungsOverShear);
    const double factor = missing_factor(response);
    FittedSprings result;
    for (std::size_t s = 0; s < springs.links.size(); ++s)
        result.springs.push_back({springs.links[s].nodes, factor * springs.stiffness[s]});

    const auto [softest, stiffest] = response.youngs_modulus_range();
    result.softest = factor * softest / kYoungsOverShear;
    result.stiffest = factor * stiffest / kYoungsOverShear;
    return result;
}

}  // namespace gelatin
