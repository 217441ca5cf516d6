#include "cpu/implicit/elastic_arrays.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace gelatin::cpu {
namespace {

constexpr std::ptrdiff_t kSortedEdges = 128;

// A tet with ascending corners. Tets by their lowest nodes are read in nearly the order of nodes and edges.
struct SortedTet {
    glm::uvec4 nodes;
    std::uint32_t tet, neo_hookean;             // in the model
    std::array<int, 4> corners = {0, 1, 2, 3};  // in the model
    float winding = 1.0f;

    SortedTet(const glm::uvec4& tet_nodes, std::uint32_t index, std::uint32_t neo_hookean_index)
        : tet(index), neo_hookean(neo_hookean_index) {
        for (std::size_t end = 3; end > 0; --end) {
            for (std::size_t k = 0; k < end; ++k) {
                if (tet_nodes[corners[k]] < tet_nodes[corners[k + 1]]) continue;
                std::swap(corners[k], corners[k + 1]);
                winding = -winding;
            }
        }
        for (int k = 0; k < 4; ++k) nodes[k] = tet_nodes[corners[static_cast<std::size_t>(k)]];
    }
    bool operator<(const SortedTet& other) const { return nodes.x < other.nodes.x; }
};

// A tet's edge: by nodes, then by tet.
struct TetEdge {
    std::uint32_t i, j, tet;

    bool operator<(const TetEdge& other) const {
        return std::array{i, j, tet} < std::array{other.i, other.j, other.tet};
    }
};
using EdgeTets = std::span<const TetEdge>;  // of one edge

class ArraysBuilder {
public:
    ArraysBuilder(const Model& model, ElasticArrays& arrays) : model_(model), arrays_(arrays) {}

    void add_springs() {
        const SpringIncidence& incidence = model_.incidence;
        for (const ModelObject& object : model_.objects)
            for (std::uint32_t first = object.nodes.first; first < object.nodes.end(); first += kGroup)
                arrays_.groups.push_back({first, std::min(kGroup, object.nodes.end() - first)});
        for (const auto& [first, count] : arrays_.groups) {
            const auto start = static_cast<std::uint32_t>(arrays_.springs.size());
            arrays_.spring_starts.push_back(start);
            arrays_.groups_of_nodes.resize(first + count,
                                           static_cast<std::uint32_t>(arrays_.spring_starts.size() - 1));
            for (std::uint32_t r = 0; r < count; ++r) {
                std::size_t at = start;
                for (std::uint32_t e = incidence.starts[first + r]; e < incidence.starts[first + r + 1];
                     ++e) {
                    if (at == arrays_.springs.size()) {
                        IndexColumn& others = arrays_.springs.emplace_back().others;
                        for (std::uint32_t k = 0; k < kGroup; ++k) others[k] = first + std::min(k, count - 1);
                        arrays_.spring_laws.emplace_back();
                    }
                    const Spring& spring = model_.springs[incidence.entries[e] / 2];
                    arrays_.springs[at].others[r] = incidence.entries[e] % 2 == 0 ? spring.j : spring.i;
                    arrays_.spring_laws[at].rest_lengths[r] = spring.rest_length;
                    arrays_.spring_laws[at++].stiffnesses[r] = spring.stiffness;
                }
            }
        }
        arrays_.spring_starts.push_back(static_cast<std::uint32_t>(arrays_.springs.size()));
    }

    // At least one tet of each kind pads, to which edges with fewer tets than others refer.
    void add_tets() {
        std::vector<SortedTet> tets[2];  // of springs, and neo-Hookean
        for (const ModelObject& object : model_.bodies()) {
            const bool is_neo_hookean = object.neo_hookean_tets.count > 0;
            for (std::uint32_t k = 0; k < object.tets.count; ++k)
                tets[is_neo_hookean ? 1 : 0].emplace_back(model_.tets[object.tets.first + k],
                                                          object.tets.first + k,
                                                          object.neo_hookean_tets.first + k);
        }
        for (std::vector<SortedTet>& kind : tets) std::stable_sort(kind.begin(), kind.end());
        for (const SortedTet& tet : tets[0]) add_tet(tet);
        arrays_.first_neo_hookean = end_kind();
        for (const SortedTet& tet : tets[1]) add_neo_hookean(tet, add_tet(tet));
        arrays_.neo_hookean.resize(end_kind() - arrays_.first_neo_hookean);
        arrays_.node_tets = make_node_tets(arrays_.node_count, nodes_);
        arrays_.node_tets.entries.resize(arrays_.node_tets.entries.size() + ElasticArrays::kAhead);
    }

    void add_edges() {
        const std::uint32_t springs_end = kGroup * arrays_.first_neo_hookean;
        std::vector<TetEdge> edges;
        for (std::uint32_t t = 0; t < nodes_.size(); ++t) {
            const glm::uvec4& n = nodes_[t];
            if (n.x == n.y) continue;  // it pads
            for (int c = 0; c < 3; ++c)
                for (int e = c + 1; e < 4; ++e) edges.push_back({n[c], n[e], t});
        }
        std::sort(edges.begin(), edges.end());
        std::vector<EdgeTets> edges_by_kind[2];  // of springs, and neo-Hookean
        for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            const TetEdge& edge = edges[begin];
            while (end < edges.size() && edges[end].i == edge.i && edges[end].j == edge.j) ++end;
            edges_by_kind[edge.tet < springs_end ? 0 : 1].push_back(
                std::span(edges).subspan(begin, end - begin));
        }
        // Edges of as many tets beside each other: the lanes of a group then have equal work.
        for (std::vector<EdgeTets>& kind : edges_by_kind) {
            for (auto part = kind.begin(); part != kind.end();) {
                const auto end = part + std::min(kSortedEdges, kind.end() - part);
                std::stable_sort(part, end, [](EdgeTets a, EdgeTets b) { return a.size() > b.size(); });
                part = end;
            }
        }
        std::vector<std::uint32_t>& starts = arrays_.half_edge_starts;
        starts.assign(arrays_.node_count + 1, 0);
        for (const std::vector<EdgeTets>& kind : edges_by_kind) {
            for (const EdgeTets& edge : kind) {
                ++starts[edge[0].i + 1];
                ++starts[edge[0].j + 1];
            }
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        arrays_.half_edge_ends.resize(starts.back());
        next_.assign(starts.begin(), starts.end() - 1);
        for (std::uint32_t kind = 0; kind < 2; ++kind) {
            arrays_.first_neo_hookean_edges = static_cast<std::uint32_t>(arrays_.edges.size());
            for (std::size_t k = 0; k < edges_by_kind[kind].size(); ++k) {
                if (k % kGroup == 0) add_edge_group(kind);
                add_edge(edges_by_kind[kind][k], k % kGroup, kind);
            }
        }
        arrays_.edge_tets.resize(arrays_.edge_tets.size() + ElasticArrays::kAhead);
        // Lanes without an edge write behind all others, each kind by itself. Rows of the last column reach
        // one float further.
        arrays_.matrices.resize(ElasticArrays::kMatrix * (starts.back() + 2) + 1);
    }

private:
    std::uint32_t add_tet(const SortedTet& tet) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        const TetRest& rest = model_.tet_rests[tet.tet];
        if (index % kGroup == 0) arrays_.tets.emplace_back();
        ElasticTets& columns = arrays_.tets.back();
        const std::size_t lane = index % kGroup;
        for (std::size_t k = 0; k < 4; ++k) columns.nodes[k][lane] = tet.nodes[static_cast<int>(k)];
        columns.inverse_six_volumes[lane] = tet.winding / (6.0f * rest.volume);
        columns.quarter_volumes[lane] = 0.25f * rest.volume;
        columns.flat_moduli[lane] = rest.volume * rest.modulus;
        if (arrays_.has_volume_term)
            columns.volume_moduli[lane] = rest.volume * model_.volume_term.tets[tet.tet];
        nodes_.push_back(tet.nodes);
        return index;
    }

    std::uint32_t end_kind() {
        if (arrays_.node_count == 0) return 0;
        if (nodes_.size() % kGroup == 0) arrays_.tets.emplace_back();
        nodes_.resize(kGroup * arrays_.tets.size(), glm::uvec4(0));
        return static_cast<std::uint32_t>(arrays_.tets.size());
    }

    void add_neo_hookean(const SortedTet& order, std::uint32_t index) {
        const NeoHookeanTet& tet = model_.neo_hookean_tets[order.neo_hookean];
        arrays_.neo_hookean.resize(index / kGroup - arrays_.first_neo_hookean + 1);
        ElasticNeoHookean& columns = arrays_.neo_hookean.back();
        const std::size_t lane = index % kGroup;
        const std::array<glm::dvec3, 4> gradients = shape_gradients(tet);
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec3 g(gradients[static_cast<std::size_t>(order.corners[c + 1])]);
            for (std::size_t k = 0; k < 3; ++k) columns.gradients[c][k][lane] = g[static_cast<int>(k)];
        }
        columns.mu[lane] = tet.gradient_1.w * tet.gradient_2.w;
        columns.lambda[lane] = tet.gradient_1.w * tet.gradient_3.w;
    }

    std::uint32_t number(const TetEdge& edge, std::uint32_t kind) const {
        const glm::uvec4& n = nodes_[edge.tet];
        std::uint32_t c = 0, e = 1;
        while (n[static_cast<int>(c)] != edge.i) ++c;
        while (n[static_cast<int>(e)] != edge.j) ++e;
        if (kind == 0) return 16 * edge.tet + 4 * c + e;
        const std::uint32_t t = edge.tet - kGroup * arrays_.first_neo_hookean;
        return ElasticArrays::kTetEdges * t + (c == 0 ? e - 1 : c + e);
    }

    void add_edge_group(std::uint32_t kind) {
        EdgeColumns& edges = arrays_.edges.emplace_back();
        edges.places.fill(static_cast<std::uint32_t>(arrays_.half_edge_ends.size()) + kind);
        edges.places_back = edges.places;
        edges.first = edges.end = static_cast<std::uint32_t>(arrays_.edge_tets.size());
    }

    void add_edge(EdgeTets edge, std::size_t lane, std::uint32_t kind) {
        EdgeColumns& edges = arrays_.edges.back();
        const auto take_place = [&](std::uint32_t node, std::uint32_t other) {
            arrays_.half_edge_ends[next_[node]] = other;
            return next_[node]++;
        };
        edges.places[lane] = take_place(edge[0].i, edge[0].j);
        edges.places_back[lane] = take_place(edge[0].j, edge[0].i);
        const std::uint32_t last =
            kGroup * static_cast<std::uint32_t>(kind == 0 ? arrays_.first_neo_hookean
                                                          : arrays_.neo_hookean.size()) -
            1;
        for (std::uint32_t k = 0; k < edge.size(); ++k) {
            if (edges.first + k == edges.end) {
                arrays_.edge_tets.emplace_back().fill(last * (kind == 0 ? 16 : ElasticArrays::kTetEdges));
                ++edges.end;
            }
            arrays_.edge_tets[edges.first + k][lane] = number(edge[k], kind);
        }
    }

    const Model& model_;
    ElasticArrays& arrays_;
    std::vector<glm::uvec4> nodes_;    // of the tets
    std::vector<std::uint32_t> next_;  // place, of each node
};

}  // namespace

ElasticArrays::ElasticArrays(const Model& model)
    : node_count(model.node_count()),
      is_damped(model.has_damping()),
      has_volume_term(!model.volume_term.is_empty()) {
    ArraysBuilder builder(model, *this);
    builder.add_springs();
    builder.add_tets();
    builder.add_edges();
    if (has_volume_term) {
        points.resize(node_count);
        tet_volumes.resize(kGroup * tets.size());
    }
    resists.resize(first_neo_hookean);
    tet_rows.resize(kGroup * tets.size());
    tet_matrices.resize(kMatrix * kTetEdges * kGroup * neo_hookean.size());
}

}  // namespace gelatin::cpu
