#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu/descent/motion.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/rigid_level.h"
#include "cpu/nodes.h"
#include "model/range.h"

namespace gelatin::cpu {

/// The rigid motions of the free bodies of an island (RigidLevel), coupled by their contacts: the matrix of a
/// step is E = W^T (M / h^2 + rows) W there, as elements hardly resist rigid motions. Motions and their
/// forces have shape [bodies].
template <class Real>
class RigidRows {
public:
    /// @param level as it was after begin(); stays where it is
    /// @param bodies of an island, those that are free, ascending @param rows of the island
    RigidRows(const RigidLevel<Real>& level, std::vector<std::uint32_t> bodies,
              std::span<const ContactRow<Real>> rows);

    std::size_t count() const { return bodies_.size(); }
    /// Among the bodies; kNoNode if it is none of them.
    std::uint32_t place_of(std::uint32_t object) const;

    /// The places of a row's two sides, or kNoNode.
    const std::array<std::uint32_t, 2>& bodies_of(std::size_t row) const { return touches_[row].bodies; }

    /// Factorises E. @param tangents of all rows
    void factorise(std::span<const RowTangent<Real>> tangents);
    /// E^-1. @param motions input: forces; output: motions
    void solve(std::span<Motion> motions) const;
    /// Adds W^T of the forces of all rows on their second sides [N].
    void add_rows(std::span<const Vec3<Real>> forces, std::span<Motion> sums) const;
    /// W^T (M / h^2) W q
    std::vector<Motion> resistance(std::span<const Motion> motions) const;
    /// s of a row for motions.
    Vec3<Real> relative(std::size_t row, std::span<const Motion> motions) const;

private:
    // Of a row's sides: the places of their bodies, or kNoNode, and where they are touched, from the centres
    // [m].
    struct Touch {
        std::array<std::uint32_t, 2> bodies{kNoNode, kNoNode};
        std::array<glm::dvec3, 2> arms{glm::dvec3(0.0), glm::dvec3(0.0)};
    };
    // All rows between two bodies, or of one and what is not free; the block of E beside the diagonal is that
    // of the larger number's rows and the smaller one's columns.
    struct Pair {
        std::array<std::uint32_t, 2> bodies;
        Range entries;  // of pair_rows_
        std::array<MotionMatrix, 3> blocks{MotionMatrix::Zero(), MotionMatrix::Zero(),
                                           MotionMatrix::Zero()};  // of the first body, of the second, both
    };
    void find_pattern();

    const RigidLevel<Real>& level_;
    std::vector<std::uint32_t> bodies_;  // objects
    std::vector<Touch> touches_;         // by row
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> pair_rows_;
    std::vector<std::uint32_t> pair_of_row_;
    Eigen::SparseMatrix<double> matrix_;  // the lower triangle of E
    std::vector<std::uint32_t> places_;   // of the pairs' blocks among those of their columns
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace gelatin::cpu
