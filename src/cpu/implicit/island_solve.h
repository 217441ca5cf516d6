#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu/implicit/rigid_rows.h"
#include "cpu/implicit/step_system.h"
#include "cpu/object_pieces.h"

namespace gelatin::cpu {

/// The solve of one island of a StepSystem, which has all that is read and written. Newton's method: first on
/// rigid motions alone (RigidRows), then on all nodes, with conjugate gradients preconditioned by both, then
/// on rigid motions again until all bodies are in balance.
template <class Real>
class IslandSolve {
public:
    /// @param bodies of the island, ascending, and its rows; of its bodies no others have any
    IslandSolve(StepSystem<Real>& system, std::span<const std::uint32_t> bodies, const Range& rows);

    /// @return what it has cost
    SolveCounts run();

private:
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
    template <class Use>
    void for_displacements(std::span<const Motion> motions, const Use& use) const;
    std::vector<Motion> gather_base() const;

    StepSystem<Real>& system_;
    std::vector<std::uint32_t> bodies_;  // objects
    std::vector<std::uint32_t> places_;  // of each body among the free ones, or kNoNode
    ObjectPieces nodes_;                 // by body
    std::span<ContactRow<Real>> rows_;   // the same of tangents, forces and slips
    std::span<RowTangent<Real>> tangents_;
    std::span<Vec3<Real>> row_forces_, slips_;
    RigidRows<Real> rigid_;
    std::vector<Motion> rigid_z_;  // what z has beside z_, of the rigid level
    SolveCounts counts_;
};

}  // namespace gelatin::cpu
