#include "model/descent/coarse_basis.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <utility>

#include "mesh/topology.h"

namespace gelatin {
namespace {

// With more clusters fewer sweeps do, and the work on clusters, which grows with their number's square,
// begins to cost as much as sweeps.
constexpr std::uint32_t kNodesPerCluster = 20, kMostClusters = 32;

// Edges are smoothed over this part of a cluster's width. In bodies of more than 30,000 nodes that would take
// longer than the rest of loading them, and they are sharper.
constexpr double kSmoothed = 0.6;
constexpr double kMostRounds = 32.0;

// Smaller weights are left out, and much smaller ones not carried on by smoothing.
constexpr float kLeastWeight = 0.03f, kLeastSpread = 1e-4f;

using Weights = std::vector<float>;  // by node of an object

// One object's.
struct Clusters {
    std::vector<Weights> weights;      // by cluster
    std::vector<std::uint32_t> cores;  // of each node
};

// Cuts one object into clusters.
class Cut {
public:
    Cut(const Model& model, const Graph& graph, const Range& nodes)
        : model_(model), graph_(graph), nodes_(nodes), nearest_(nodes.count, 0) {
        for (std::uint32_t n = 0; n < nodes_.count; ++n) free_count_ += is_free(n) ? 1 : 0;
    }

    Clusters clusters() {
        const std::uint32_t most = std::min(free_count_ / kNodesPerCluster, kMostClusters);
        if (most < 2) return {};
        const std::uint32_t count = spread_centers(most);
        // How far smoothing carries grows with the square root of its rounds.
        const double width = kSmoothed * std::cbrt(static_cast<double>(nodes_.count) / count);
        const int rounds = static_cast<int>(std::ceil(std::min(width * width, kMostRounds)));
        std::vector<Weights> weights(count);
        tbb::parallel_for(std::uint32_t(0), count,
                          [&](std::uint32_t k) { weights[k] = smoothed(core_of(k), rounds); });
        leave_out_small(smoothed(free_nodes(), rounds), weights);
        return {std::move(weights), std::move(nearest_)};
    }

private:
    using Distances = std::vector<float>;
    using Nodes = std::vector<std::uint32_t>;

    bool is_free(std::uint32_t n) const { return model_.positions[nodes_.first + n].w > 0.0f; }
    glm::vec3 position(std::uint32_t n) const { return glm::vec3(model_.positions[nodes_.first + n]); }

    // Each centre is the free node that is farthest, along edges, from those before it; the first is far from
    // any. Returns how many there are room for.
    std::uint32_t spread_centers(std::uint32_t most) {
        const Distances infinite(nodes_.count, std::numeric_limits<float>::infinity());
        Distances distances = infinite;
        claim(farthest(distances), 0, distances);
        const std::uint32_t first = farthest(distances);
        distances = infinite;
        claim(first, 0, distances);
        for (std::uint32_t count = 1; count < most; ++count) {
            const std::uint32_t center = farthest(distances);
            if (distances[center] == 0.0f) return count;
            claim(center, count, distances);
        }
        return most;
    }

    std::uint32_t farthest(const Distances& distances) const {
        std::uint32_t result = 0;
        float most = -1.0f;
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            if (is_free(n) && distances[n] > most) most = distances[result = n];
        }
        return result;
    }

    // Dijkstra's algorithm over the nodes that are nearer to this centre than to those before.
    void claim(std::uint32_t center, std::uint32_t cluster, Distances& distances) {
        using Visit = std::pair<float, std::uint32_t>;
        std::priority_queue<Visit, std::vector<Visit>, std::greater<>> visits;
        visits.emplace(0.0f, center);
        while (!visits.empty()) {
            const auto [distance, n] = visits.top();
            visits.pop();
            if (distance >= distances[n]) continue;
            distances[n] = distance;
            nearest_[n] = cluster;
            for (const std::uint32_t neighbour : graph_.row(nodes_.first + n)) {
                const std::uint32_t other = neighbour - nodes_.first;
                visits.emplace(distance + glm::distance(position(n), position(other)), other);
            }
        }
    }

    Nodes free_nodes() const {
        Nodes nodes;
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            if (is_free(n)) nodes.push_back(n);
        }
        return nodes;
    }

    Nodes core_of(std::uint32_t cluster) const {
        Nodes core = free_nodes();
        core.erase(
            std::remove_if(core.begin(), core.end(), [&](std::uint32_t n) { return nearest_[n] != cluster; }),
            core.end());
        return core;
    }

    // One in these nodes and nothing elsewhere; then, round after round, each free node's becomes the mean of
    // its own and its neighbours'.
    Weights smoothed(Nodes reached, int rounds) const {
        Weights weights(nodes_.count, 0.0f), next(nodes_.count, 0.0f);
        for (const std::uint32_t n : reached) weights[n] = 1.0f;
        std::vector<bool> is_reached(nodes_.count, false);
        for (const std::uint32_t n : reached) is_reached[n] = true;
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t k = 0, count = reached.size(); k < count; ++k) {
                if (weights[reached[k]] < kLeastSpread) continue;
                for (const std::uint32_t neighbour : graph_.row(nodes_.first + reached[k])) {
                    const std::uint32_t other = neighbour - nodes_.first;
                    if (is_reached[other] || !is_free(other)) continue;
                    is_reached[other] = true;
                    reached.push_back(other);
                }
            }
            for (const std::uint32_t n : reached) {
                float sum = weights[n];
                for (const std::uint32_t other : graph_.row(nodes_.first + n))
                    sum += weights[other - nodes_.first];
                next[n] = sum / static_cast<float>(graph_.degree(nodes_.first + n) + 1);
            }
            for (const std::uint32_t n : reached) weights[n] = next[n];
        }
        return weights;
    }

    // A node's others grow until they are as much as all were.
    void leave_out_small(const Weights& all, std::vector<Weights>& by_cluster) const {
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            float left = 0.0f;
            for (Weights& weights : by_cluster) {
                if (weights[n] < kLeastWeight) weights[n] = 0.0f;
                left += weights[n];
            }
            if (!(left > 0.0f)) continue;
            for (Weights& weights : by_cluster) weights[n] *= all[n] / left;
        }
    }

    const Model& model_;
    const Graph& graph_;
    Range nodes_;
    std::uint32_t free_count_ = 0;
    std::vector<std::uint32_t> nearest_;  // centre
};

double length_of(const Model& model, const Range& nodes) {
    glm::vec3 least(model.positions[nodes.first]), most = least;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        least = glm::min(least, glm::vec3(model.positions[n]));
        most = glm::max(most, glm::vec3(model.positions[n]));
    }
    return static_cast<double>(glm::distance(least, most));
}

void append_core(const Model& model, const Range& nodes, std::uint32_t k, const Clusters& clusters,
                 CoarseBasis& basis) {
    glm::dvec3 sum(0.0);
    double mass = 0.0;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        if (clusters.cores[n - nodes.first] != k || model.positions[n].w == 0.0f) continue;
        basis.core_nodes.push_back(n);
        sum += static_cast<double>(model.masses[n]) * glm::dvec3(model.positions[n]);
        mass += static_cast<double>(model.masses[n]);
    }
    basis.core_starts.push_back(static_cast<std::uint32_t>(basis.core_nodes.size()));
    basis.middles.push_back(sum / mass);
}

void append(const Model& model, const Range& nodes, const Clusters& clusters, CoarseBasis& basis) {
    const std::vector<Weights>& weights = clusters.weights;
    const Range range{basis.cluster_count(), static_cast<std::uint32_t>(weights.size())};
    basis.objects.push_back(range);
    basis.lengths.push_back(length_of(model, nodes));
    for (std::uint32_t k = 0; k < range.count; ++k) {
        append_core(model, nodes, k, clusters, basis);
        for (std::uint32_t n = 0; n < nodes.count; ++n) {
            if (weights[k][n] > 0.0f) basis.cluster_parts.push_back({nodes.first + n, weights[k][n]});
        }
        basis.cluster_starts.push_back(static_cast<std::uint32_t>(basis.cluster_parts.size()));
    }
    for (std::uint32_t n = 0; n < nodes.count; ++n) {
        for (std::uint32_t k = 0; k < range.count; ++k) {
            if (weights[k][n] > 0.0f) basis.node_parts.push_back({range.first + k, weights[k][n]});
        }
        basis.node_starts.push_back(static_cast<std::uint32_t>(basis.node_parts.size()));
    }
}

}  // namespace

CoarseBasis make_coarse_basis(const Model& model) {
    const Graph graph = make_graph(model.node_count(), tet_edges(model.tets));
    std::vector<Clusters> clusters(model.objects.size());
    tbb::parallel_for(std::size_t(0), clusters.size(), [&](std::size_t o) {
        clusters[o] = Cut(model, graph, model.objects[o].nodes).clusters();
    });
    CoarseBasis basis;
    for (std::vector<std::uint32_t>* starts : {&basis.node_starts, &basis.cluster_starts, &basis.core_starts})
        starts->push_back(0);
    for (std::size_t o = 0; o < clusters.size(); ++o)
        append(model, model.objects[o].nodes, clusters[o], basis);
    return basis;
}

}  // namespace gelatin
