#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/elastic_system.h"
#include "cpu/implicit/glued_nodes.h"
#include "cpu/implicit/island_rows.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What solving a step has cost, all islands together.
struct SolveCounts {
    int iterations = 0;                  ///< of conjugate gradients
    std::uint64_t multiplied_nodes = 0;  ///< of products with the matrix, each time anew

    SolveCounts& operator+=(const SolveCounts& more);
};

/// The displacements d of a step as the least of
///   sum_i m_i / (2 h^2) |x_i + d_i - y_i|^2 + d^T K d / 2 - f^T d + sum of rows,
/// with elements to second order (ElasticSystem), and contacts by their law, friction among it. It falls
/// apart into islands, bodies with rows in common, and each is solved by itself (IslandSolve): none waits for
/// another, and small ones stay in the cache of one core.
template <class Real>
class StepSystem {
public:
    explicit StepSystem(std::shared_ptr<const Model> model);

    ElasticSystem<Real> elastic;
    RigidLevel<Real> rigid;
    std::vector<Real> inertia;      ///< m / h^2 [N/m], 0 for held nodes, shape [nodes]
    std::vector<Vec3<Real>> loads;  ///< m / h^2 (y - x) + f [N], shape [nodes]
    std::vector<ContactRow<Real>> rows;
    std::vector<Vec3<Real>> displacements;  ///< d [m]; input: of held nodes, and a guess; output: of all
    int iterations = 10;                    ///< of conjugate gradients for each linearisation, at most
    std::vector<double> enough;             ///< energy by which each may miss its least, by object [J]
    SolveCounts counts;

    /// @param asleep bodies whose nodes are all held
    void leave_out(std::span<const std::uint8_t> asleep);
    /// Rows come into the order of islands and pairs of objects. @pre rigid.begin was called
    /// @param islands_of_bodies of each body the least one of its island (Islands::of_bodies)
    void solve(std::span<const std::uint32_t> islands_of_bodies);
    /// s of rows, as they were found: by displacements, which are rounded, joints would exert other forces.
    std::span<const Vec3<Real>> slips() const { return slips_; }
    /// By displacements, after these were changed.
    void find_slips();
    /// Of elements, at the displacements [N], shape [nodes]; 0 of bodies asleep.
    std::vector<Vec3<Real>> elastic_forces();

private:
    template <class>
    friend class IslandSolve;
    using Field = std::vector<Vec3<Real>>;
    struct RowEntry {
        std::uint32_t row, place;
    };
    // Bodies that are awake, ascending, and their rows.
    struct Island {
        std::vector<std::uint32_t> bodies;
        Range rows{0, 0};
        std::vector<RowPair> pairs;  // rows: among those of the island
    };

    std::vector<Island> sort_by_island(std::span<const std::uint32_t> islands_of_bodies);
    void index_rows();
    // With a node among theirs.
    std::span<const RowEntry> rows_at(std::uint32_t node) const {
        return std::span(row_entries_).subspan(row_starts_[node], row_starts_[node + 1] - row_starts_[node]);
    }

    std::shared_ptr<const Model> model_;
    std::vector<std::uint8_t> asleep_;  // bodies
    std::vector<std::uint32_t> row_starts_;
    std::vector<RowEntry> row_entries_;  // by node
    GluedNodes<Real> glued_;
    std::vector<RowTangent<Real>> tangents_;
    Field row_forces_, slips_;                           // slips: s of rows, by displacements
    std::vector<SymmetricMatrix<Real>> inverse_blocks_;  // of nodes
    Field base_, residual_, step_, product_, z_;         // base: loads - A d, without rows
};

}  // namespace gelatin::cpu
