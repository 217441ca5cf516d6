#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cpu/descent/motion.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "cpu/object_pieces.h"
#include "model/for_each_index.h"
#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {

/// The rigid motions of all free bodies, as a subspace of the displacements of all nodes: W, with six columns
/// a body, in which the matrix of a step is E = W^T (M / h^2 + rows) W. Elements hardly resist rigid motions.
/// A motion of a body is its displacement [m] and its rotation [rad] about the centre of mass; its forces are
/// force [N] and moment [N m] there.
template <class Real>
class RigidLevel {
public:
    explicit RigidLevel(std::shared_ptr<const Model> model);

    /// @param positions where the step begins [m]; w: 0 where a node is held
    /// @param inertia m / h^2 [N/m]; both shape [nodes]
    void begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia);
    /// Sets the rows, whose order does not change until it is called again.
    void set_rows(std::span<const ContactRow<Real>> rows);

    bool is_free(std::size_t object) const { return numbers_[object] != kNoNode; }
    bool is_empty() const { return bodies_.empty(); }
    std::uint32_t number(std::size_t object) const { return numbers_[object]; }
    std::size_t count() const { return bodies_.size(); }
    std::uint32_t object(std::size_t number) const { return bodies_[number].object; }
    /// From its free body's centre to a node [m].
    const Vec3<Real>& arm(std::size_t node) const { return arms_[node]; }
    /// Of mass, of a free body where the step begins [m].
    const glm::dvec3& center(std::size_t object) const { return bodies_[numbers_[object]].center; }

    /// Factorises E. @param tangents of all rows
    void factorise(std::span<const RowTangent<Real>> tangents);

    /// E^-1. @param motions input: forces; output: motions; shape [free bodies]
    void solve(std::span<Motion> motions) const;
    /// W^T r. @param residual r [N], shape [nodes]
    std::vector<Motion> gather(std::span<const Vec3<Real>> residual) const;
    /// Adds W^T of the forces of all rows on their second sides [N].
    void add_rows(std::span<const Vec3<Real>> forces, std::span<Motion> sums) const;
    /// W^T (M / h^2) W q
    std::vector<Motion> resistance(std::span<const Motion> motions) const;
    /// s of a row for motions.
    Vec3<Real> relative(std::size_t row, std::span<const Motion> motions) const;
    /// The rigid part of the velocities of a free body's nodes, by momentum and angular momentum [m/s],
    /// [rad/s].
    Motion velocity(std::size_t object, std::span<const Vec4<Real>> velocities) const;
    /// A motion where a node of a free body is.
    Vec3<Real> at(std::size_t node, std::span<const Motion> motions) const {
        const Motion& m = motions[body_of_[node]];
        return Vec3<Real>(m(0), m(1), m(2)) + glm::cross(Vec3<Real>(m(3), m(4), m(5)), arms_[node]);
    }
    /// W q: use(node, displacement [m]) for all nodes, on several threads; 0 for bodies that are not free.
    template <class Use>
    void for_displacements(const ObjectPieces& nodes, std::span<const Motion> motions, const Use& use) const {
        std::vector<std::pair<Vec3<Real>, Vec3<Real>>> parts;
        for (const Motion& m : motions)
            parts.push_back({Vec3<Real>(m(0), m(1), m(2)), Vec3<Real>(m(3), m(4), m(5))});
        nodes.for_each([&](std::uint32_t n) {
            const std::uint32_t b = body_of_[n];
            use(n, b == kNoNode ? Vec3<Real>(0) : parts[b].first + glm::cross(parts[b].second, arms_[n]));
        });
    }

    /// What a step of true rotations differs by from a linear one, d = s + w x r, to second order, for the
    /// rotation w that inertia wants: the displacements w x (w x r) / 2 are taken out, and forces rotate with
    /// their bodies.
    /// @param displacements that inertia wants [m] @param forces of elements [N]; both input and output
    void follow_rotation(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                         std::span<Vec3<Real>> displacements, std::span<Vec3<Real>> forces) const;

    /// The rigid part of a displacement of free bodies becomes a true rotation: to first order, as linear
    /// systems have it, bodies would grow. @param displacements input and output [m]
    void rotate(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                std::span<Vec3<Real>> displacements) const;

private:
    struct Body {
        std::uint32_t object;
        glm::dvec3 center{0.0};
        double weight = 0.0;  // m / h^2 of a mass of 1 kg [1/s^2]
        MotionMatrix matrix = MotionMatrix::Zero(), inverse = MotionMatrix::Zero();
    };
    // Of a row's sides: their bodies' numbers, or kNoNode, and where they are touched, from the centres [m].
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
    Motion rigid_part(const Body& body, std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                      std::span<const Vec3<Real>> displacements) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> numbers_;  // of objects among the free bodies, or kNoNode
    std::vector<std::uint32_t> body_of_;  // of nodes, the same
    std::vector<Body> bodies_;
    ObjectPieces pieces_;
    std::vector<Vec3<Real>> arms_;  // of nodes, from their bodies' centres [m]
    std::vector<Touch> touches_;    // by row
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> pair_rows_;
    std::vector<std::uint32_t> pair_of_row_;
    Eigen::SparseMatrix<double> matrix_;  // the lower triangle of E
    std::vector<std::uint32_t> places_;   // of the pairs' blocks among those of their columns
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace gelatin::cpu
