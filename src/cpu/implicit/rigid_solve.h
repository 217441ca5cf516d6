#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/implicit/island_rows.h"
#include "cpu/implicit/motion.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/range.h"

namespace gelatin::cpu {

/// The rigid motions of the free bodies of an island (RigidLevel), coupled by their contacts: Newton's method
/// for their balance. The matrix of a step of it is E = W^T (M / h^2 + rows) W, as elements hardly resist
/// rigid motions; conjugate gradients solve it, with the blocks of bodies as preconditioner. Motions and
/// their forces have shape [bodies].
///
/// Bodies that are rigid rotate truly: the arms of their rows do with the rotation R found so far, and s gets
/// what R r differs by from r + w x r (ContactRow::turned). To E comes how the moment of a row's force f on
/// the body changes by that: G = (f . r) 1 - (f r^T + r f^T) / 2, as far as it is positive.
template <class Real>
class RigidSolve {
public:
    /// @param level as it was after begin() @param bodies of an island, those that are free, ascending
    /// @param pairs all of the island, with rows among its rows. What is referred to stays where it is.
    RigidSolve(const Model& model, const RigidLevel<Real>& level, std::vector<std::uint32_t> bodies,
               const IslandRows<Real>& rows, std::span<const RowPair> pairs);

    std::size_t count() const { return bodies_.size(); }
    /// Among the bodies; kNoNode if it is none of them.
    std::uint32_t place_of(std::uint32_t object) const;

    /// E. @param tangents of rows
    void find_matrix(std::span<const RowTangent<Real>> tangents);
    /// E_b^-1 f, with E_b the block of a body on the diagonal of E.
    Motion precondition(std::size_t body, const Motion& force) const { return inverses_[body] * force; }
    /// E^-1. @param motions input: forces; output: motions @param left what may still be lacking of the
    /// energy, as a part of what was @return iterations
    std::uint32_t solve(std::span<Motion> motions, double left) const;
    /// Adds W^T of the forces of rows.
    void add_rows(std::span<Motion> sums) const;
    /// s of a row for motions.
    Vec3<Real> relative(std::size_t row, std::span<const Motion> motions) const {
        return relative(row, arms_[row], motions);
    }

    /// Newton's method; slips follow. @param base forces of all but rows, where it begins @param begun
    /// motions of rigid bodies that displacements have already; others do not count @return motions
    std::vector<Motion> run(std::vector<Motion> base, std::span<const Motion> begun);

private:
    // The places of its bodies, or kNoNode; of a body with itself none: its rows hardly resist its motion.
    // What its rows resist with, H, is at their points r of both sides: sums of H, -H [r], -[r] H [r], and
    // -[r_0] H [r_1] for what couples them, where [r] v = r x v. Of rows that exert moments alone, r is a
    // difference of points, and only what has moments counts.
    struct Pair {
        std::array<std::uint32_t, 2> bodies;
        Range rows;
        glm::dmat3 stiffness{0.0}, across{0.0};
        std::array<glm::dmat3, 2> by_rotation{}, moments{};
    };
    struct Coupling {
        std::uint32_t pair, side;  // of the body itself
    };
    std::vector<Motion> multiply(std::span<const Motion> motions) const;
    void rotate(std::span<const Motion> motions);
    void find_turning();
    Vec3<Real> relative(std::size_t row, const std::array<glm::dvec3, 2>& arms,
                        std::span<const Motion> motions) const;
    bool is_balanced(double tolerance, std::span<const Motion> forces) const;

    const Model& model_;
    const RigidLevel<Real>& level_;
    const IslandRows<Real>& rows_;
    std::vector<std::uint32_t> bodies_;  // objects
    std::vector<std::uint8_t> are_rigid_;
    std::vector<std::array<glm::dvec3, 2>> arms_, straight_arms_;  // of rows, from their bodies' centres [m]
    std::vector<glm::dmat3> turning_;                              // G of bodies
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> pair_of_row_;
    std::vector<std::uint32_t> coupling_starts_;  // by body
    std::vector<Coupling> couplings_;
    std::vector<MotionMatrix> diagonal_, inverses_;  // by body: E_b, E_b^-1
};

}  // namespace gelatin::cpu
