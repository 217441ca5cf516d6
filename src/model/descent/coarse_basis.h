#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// The coarse level of block descent: a few motions of each body that reach far, where sweeps carry what they
/// find from neighbour to neighbour. Clusters of nodes overlap and move as rigid ones, by a translation s and
/// a rotation r each, so that node i goes
///   d_i = sum_k w_ik (s_k + r_k x (x_i - c_k)),
/// with c_k the middle of the cluster's core, the nodes that are nearest to it. A node's weights sum to one,
/// less near pinned nodes, whose own are zero (aggregates with smoothed edges: Vanek, Mandel, Brezina 1996;
/// weights as in skinning).
struct CoarseBasis {
    struct Part {
        std::uint32_t index;  ///< of a cluster, or of a node
        float weight;         ///< in (0, 1]
    };

    std::vector<Range> objects;              ///< clusters of each object; none of those that sweeps do alone
    std::vector<double> lengths;             ///< of each object at rest, corner to corner of its box [m]
    std::vector<std::uint32_t> node_starts;  ///< shape [nodes + 1]
    std::vector<Part> node_parts;            ///< clusters of each node, ascending
    std::vector<std::uint32_t> cluster_starts;  ///< shape [clusters + 1]
    std::vector<Part> cluster_parts;            ///< nodes of each cluster, ascending
    std::vector<std::uint32_t> core_starts;     ///< shape [clusters + 1]
    std::vector<std::uint32_t> core_nodes;      ///< of each cluster those that are in no other one's core
    std::vector<glm::dvec3> middles;            ///< c at rest: of the core's mass [m], shape [clusters]

    std::uint32_t cluster_count() const { return static_cast<std::uint32_t>(middles.size()); }
    std::span<const Part> clusters_of(std::uint32_t node) const {
        return {node_parts.data() + node_starts[node], node_parts.data() + node_starts[node + 1]};
    }
    std::span<const Part> nodes_of(std::uint32_t cluster) const {
        return {cluster_parts.data() + cluster_starts[cluster],
                cluster_parts.data() + cluster_starts[cluster + 1]};
    }
    std::span<const std::uint32_t> core_of(std::uint32_t cluster) const {
        return {core_nodes.data() + core_starts[cluster], core_nodes.data() + core_starts[cluster + 1]};
    }
};

CoarseBasis make_coarse_basis(const Model& model);

}  // namespace gelatin
