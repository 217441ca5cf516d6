#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <span>
#include <vector>

#include "cpu/descent/motion.h"
#include "cpu/implicit/contact_row.h"
#include "cpu/nodes.h"
#include "cpu/object_pieces.h"
#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {

/// The rigid motions of all free bodies, as a subspace of the displacements of all nodes: W, with six columns
/// a body, in which the matrix of a step is E = W^T (M / h^2 + rows) W. Elements hardly resist rigid motions.
template <class Real>
class RigidLevel {
public:
    explicit RigidLevel(std::shared_ptr<const Model> model);

    /// @param positions where the step begins [m]; w: 0 where a node is held
    /// @param inertia m / h^2 [N/m]; both shape [nodes]
    void begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia);

    bool is_free(std::size_t object) const { return numbers_[object] != kNoNode; }
    bool is_empty() const { return bodies_.empty(); }

    /// Factorises E. Tangents are those of `rows`.
    void factorise(std::span<const ContactRow<Real>> rows, std::span<const RowTangent<Real>> tangents);

    /// W E^-1 W^T r. @param residual r [N] @param displacements output [m], 0 for bodies that are not free
    void solve(std::span<const Vec3<Real>> residual, std::span<Vec3<Real>> displacements);

    /// The sum of a residual over each free body [N], and what it is compared to.
    std::vector<glm::dvec3> net_forces(std::span<const Vec3<Real>> residual) const;
    std::uint32_t number(std::size_t object) const { return numbers_[object]; }
    std::size_t count() const { return bodies_.size(); }

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
        double weight = 0.0;  // sum of m / h^2
        MotionMatrix matrix = MotionMatrix::Zero(), inverse = MotionMatrix::Zero();
    };
    std::vector<Motion> gather(std::span<const Vec3<Real>> residual) const;
    Motion rigid_part(const Body& body, std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                      std::span<const Vec3<Real>> displacements) const;

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> numbers_;  // of objects among the free bodies, or kNoNode
    std::vector<Body> bodies_;
    ObjectPieces pieces_;
    std::vector<Vec4<Real>> positions_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
    bool is_coupled_ = false;
};

}  // namespace gelatin::cpu
