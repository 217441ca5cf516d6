#include "model/coarse_basis.h"

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

// Edges are smoothed over this part of a cluster's width.
constexpr double kSmoothed = 0.6;

// Smaller weights are left out.
constexpr float kLeastWeight = 0.03f;

// One object's.
struct Clusters {
    std::vector<std::vector<float>> weights;  // by cluster, then by node of the object
    std::vector<std::uint32_t> cores;         // of each node
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
        std::vector<std::vector<float>> weights(count, std::vector<float>(nodes_.count, 0.0f));
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            if (is_free(n)) weights[nearest_[n]][n] = 1.0f;
        }
        // The way that smoothing carries grows with the square root of its rounds.
        const double width = kSmoothed * std::cbrt(static_cast<double>(nodes_.count) / count);
        const int rounds = static_cast<int>(std::ceil(width * width));
        for (std::vector<float>& values : weights) {
            for (int round = 0; round < rounds; ++round) smooth(values);
        }
        leave_out_small(weights);
        return {std::move(weights), std::move(nearest_)};
    }

private:
    using Distances = std::vector<float>;

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

    // Each node's becomes the mean of its own and its neighbours'.
    void smooth(std::vector<float>& weights) const {
        std::vector<float> smoothed(weights.size(), 0.0f);
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            if (!is_free(n)) continue;
            float sum = weights[n];
            for (const std::uint32_t other : graph_.row(nodes_.first + n))
                sum += weights[other - nodes_.first];
            smoothed[n] = sum / static_cast<float>(graph_.degree(nodes_.first + n) + 1);
        }
        weights = std::move(smoothed);
    }

    // A node's others grow by as much.
    void leave_out_small(std::vector<std::vector<float>>& by_cluster) const {
        for (std::uint32_t n = 0; n < nodes_.count; ++n) {
            float all = 0.0f, left = 0.0f;
            for (std::vector<float>& weights : by_cluster) {
                all += weights[n];
                if (weights[n] < kLeastWeight) weights[n] = 0.0f;
                left += weights[n];
            }
            if (!(left > 0.0f)) continue;
            for (std::vector<float>& weights : by_cluster) weights[n] *= all / left;
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
    const std::vector<std::vector<float>>& weights = clusters.weights;
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
