#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/elastic_system.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What solving a step has cost.
struct SolveCounts {
    int products = 0;       ///< with the matrix of all nodes
    int iterations = 0;     ///< of conjugate gradients
    int rigid_rounds = 0;   ///< Newton's method on rigid motions
    int line_searches = 0;  ///< that shortened a step
};

/// The displacements d of a step as the least of
///   sum_i m_i / (2 h^2) |x_i + d_i - y_i|^2 + d^T K d / 2 - f^T d + sum of rows,
/// with elements to second order (ElasticSystem), and contacts by their law, friction among it. Newton's
/// method: first on rigid motions alone (RigidLevel), then on all nodes, with conjugate gradients
/// preconditioned by both, then on rigid motions again until all bodies are in balance.
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
    /// @pre rigid.begin was called
    void solve();
    /// Of elements, at the displacements [N], shape [nodes].
    std::vector<Vec3<Real>> elastic_forces();

private:
    using Field = std::vector<Vec3<Real>>;

    void index_rows();
    template <class ForceOf>
    void find_row_forces(const ForceOf& force_of);
    Vec3<Real> of_rows(std::uint32_t node) const;
    void find_base_residual();
    void find_slips();
    void find_tangents();
    void find_chords(std::span<const Vec3<Real>> expected);
    void set_limits();
    void prepare_preconditioner(bool only_rows);
    template <class Update>
    double precondition(const Update& update, bool& is_enough);
    double multiply_direction();
    int conjugate_gradients(int count, double forcing);
    double line_search(std::span<const Vec3<Real>> changes, double base, double curvature);
    bool is_balanced(double tolerance, std::span<const Motion> forces) const;
    void rigid_newton();
    bool newton_step(int most_iterations, double forcing, bool is_first);

    std::shared_ptr<const Model> model_;
    ObjectPieces pieces_, awake_;                          // of bodies' nodes; of those that move
    std::vector<std::uint32_t> row_starts_, row_entries_;  // by node: 4 row + place
    std::vector<RowTangent<Real>> tangents_;
    std::vector<Vec3<Real>> row_forces_, slips_;         // slips: s of rows, by displacements
    std::vector<SymmetricMatrix<Real>> inverse_blocks_;  // of nodes
    Field base_, residual_, step_, product_, z_;         // base: loads - A d, without rows
    std::vector<Motion> rigid_z_;                        // what z has beside z_, of the rigid level
};

}  // namespace gelatin::cpu
