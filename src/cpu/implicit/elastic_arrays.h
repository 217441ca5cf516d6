#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "cpu/groups.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

using FloatColumn = std::array<float, kGroup>;
using IndexColumn = std::array<std::uint32_t, kGroup>;

/// A half spring of each node of a group, linearised.
struct alignas(32) LinearSprings {         // 160 bytes
    IndexColumn others;                    ///< the node itself where it has no more springs
    std::array<FloatColumn, 3> stretches;  ///< sqrt(k - across) times the direction
    FloatColumn across;                    ///< [N/m]
};
struct alignas(32) SpringLaws {
    FloatColumn rest_lengths, stiffnesses;
};

/// The corners ascend, whichever way they are wound. So an edge has one direction in all of its tets.
struct alignas(32) ElasticTets {
    std::array<IndexColumn, 4> nodes;
    FloatColumn inverse_six_volumes;         ///< negative where the corners are wound the other way [1/m^3]
    FloatColumn quarter_volumes;             ///< V / 4 [m^3]
    FloatColumn volume_moduli, flat_moduli;  ///< times V [J]
};
struct alignas(32) ElasticNeoHookean {
    std::array<std::array<FloatColumn, 3>, 3> gradients;  ///< of the corners 1, 2, 3 at rest [1/m]
    FloatColumn mu, lambda;                               ///< times V [J]
};

/// Of corner c sqrt(K) dJ/dx, with K the tet's stiffness [J] against changes of J; minus its product with w
/// is the force. Neo-Hookean: minus the force, and 1.
struct alignas(64) TetRows {
    std::array<glm::vec4, 4> corners;
};

/// Of a group of edges.
struct EdgeColumns {
    IndexColumn places, places_back;  ///< of its matrices, from its lower node and from the other
    std::uint32_t first, end;         ///< in edge_tets
};

/// What ElasticSystem<float> reads and writes, with nodes, tets and edges in groups of kGroup, one in each
/// lane; nodes of one object. Springs stay half springs. What tets add to K is summed by edge, as a matrix M
/// between two nodes:
///   (K d)_n = sum over edges of M_nj (d_n - d_j),
/// which needs none for single nodes, since no element resists translation. Tets of springs come first, then
/// neo-Hookean ones, each padded with tets that resist nothing; so do their edges.
struct ElasticArrays {
    static constexpr std::uint32_t kMatrix = 9;    ///< floats of a matrix, by columns
    static constexpr std::uint32_t kTetEdges = 6;  ///< between corners: 01 02 03 12 13 23
    /// Entries of lists are prefetched so far ahead, behind their ends, too.
    static constexpr std::uint32_t kAhead = 12;

    explicit ElasticArrays(const Model& model);

    std::uint32_t node_count;
    bool is_damped, has_volume_term;

    std::vector<Range> groups;  ///< of nodes of one object, up to kGroup
    std::vector<std::uint32_t> groups_of_nodes;
    std::vector<std::uint32_t> spring_starts;  ///< of each group of nodes, and the end
    std::vector<LinearSprings> springs;
    std::vector<SpringLaws> spring_laws;

    std::vector<ElasticTets> tets;
    std::uint32_t first_neo_hookean = 0;         ///< a group
    std::vector<ElasticNeoHookean> neo_hookean;  ///< from there on
    NodeTets node_tets;

    std::vector<EdgeColumns> edges;
    std::uint32_t first_neo_hookean_edges = 0;
    /// Of springs 16 t + 4 c + e, with c < e the edge's corners; else 6 t + its number in kTetEdges, with t
    /// among neo-Hookean tets.
    std::vector<IndexColumn> edge_tets;
    std::vector<std::uint32_t> half_edge_starts;  ///< of each node, and the end
    std::vector<std::uint32_t> half_edge_ends;    ///< the other nodes

    std::vector<glm::vec4> points;      ///< xyz [m], stress of the volume term [Pa], shape [nodes]
    std::vector<float> tet_volumes;     ///< a quarter of each [m^3]
    std::vector<std::uint8_t> resists;  ///< whether one of a group of tets of springs has any stiffness
    std::vector<TetRows> tet_rows;
    std::vector<float> tet_matrices;  ///< of the edges of neo-Hookean tets [N/m]
    std::vector<float> matrices;      ///< of half edges [N/m]
    bool has_matrices = false;        ///< whether any is not 0
};

}  // namespace gelatin::cpu
