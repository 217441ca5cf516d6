#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu/implicit/island_rows.h"
#include "cpu/implicit/rigid_solve.h"
#include "cpu/implicit/step_system.h"
#include "cpu/object_pieces.h"

namespace gelatin::cpu {

/// The solve of one island of a StepSystem, which has all that is read and written. Newton's method: first on
/// rigid motions alone (RigidSolve), then on all nodes, with conjugate gradients, then on rigid motions again
/// until all bodies are in balance. Blocks precondition: those of nodes, and of bodies as rigid ones, with
/// what is glued to them (GluedNodes).
template <class Real>
class IslandSolve {
public:
    /// @param bodies of the island, ascending, and its rows; of its bodies no others have any
    /// @param pairs of these rows
    IslandSolve(StepSystem<Real>& system, std::span<const std::uint32_t> bodies, const Range& rows,
                std::span<const RowPair> pairs);

    /// @return what it has cost
    SolveCounts run();

private:
    Vec3<Real> of_rows(std::uint32_t node) const;
    void find_base_residual();
    void find_slips();
    SymmetricMatrix<Real> block_of(std::uint32_t node) const;
    void prepare_preconditioner(bool only_rows);
    Vec3<Real> with_glued(std::uint32_t node) const;
    void move_glued();
    template <class Update>
    double precondition(const Update& update, bool& is_enough);
    double multiply_direction();
    int conjugate_gradients(int count, double forcing);
    void rigid_newton();
    bool newton_step(int most_iterations, double forcing, bool is_first);
    template <class Use>
    void for_displacements(std::span<const Motion> motions, const Use& use) const;
    std::vector<Motion> gather_base() const;

    StepSystem<Real>& system_;
    std::vector<std::uint32_t> bodies_;  // objects
    std::vector<std::uint32_t> places_;  // of each body among the free ones, or kNoNode
    ObjectPieces nodes_;                 // by body
    std::uint32_t first_row_;
    bool has_glued_ = false;
    IslandRows<Real> rows_;
    std::vector<RowTangent<Real>> felt_;  // tangents, but of glue what leaders feel: the glued node
    RigidSolve<Real> rigid_;
    std::vector<Motion> rigid_z_;  // what z has beside z_, of the rigid level
    SolveCounts counts_;
};

}  // namespace gelatin::cpu
