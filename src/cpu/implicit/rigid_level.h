#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cpu/implicit/contact_row.h"
#include "cpu/implicit/motion.h"
#include "cpu/nodes.h"
#include "model/model.h"
#include "model/spring_packing.h"

namespace gelatin::cpu {

/// The rigid motions of all free bodies, as a subspace of the displacements of all nodes: W, with six columns
/// a body.
/// A motion of a body is its displacement [m] and its rotation [rad] about the centre of mass; its forces are
/// force [N] and moment [N m] there.
template <class Real>
class RigidLevel {
public:
    explicit RigidLevel(std::shared_ptr<const Model> model);

    /// @param positions where the step begins [m]; w: 0 where a node is held
    /// @param inertia m / h^2 [N/m]; both shape [nodes]
    void begin(std::span<const Vec4<Real>> positions, std::span<const Real> inertia);
    bool is_free(std::size_t object) const { return numbers_[object] != kNoNode; }
    std::uint32_t number(std::size_t object) const { return numbers_[object]; }
    /// Of the body that a node belongs to.
    std::uint32_t number_at(std::size_t node) const { return body_of_[node]; }
    std::size_t count() const { return bodies_.size(); }
    /// From its free body's centre to a node [m].
    const Vec3<Real>& arm(std::size_t node) const { return arms_[node]; }
    /// Of mass, of a free body where the step begins [m].
    const glm::dvec3& center(std::size_t object) const { return bodies_[numbers_[object]].center; }

    /// s of a row for motions of all free bodies.
    Vec3<Real> relative(const ContactRow<Real>& row, std::span<const Motion> motions) const;
    /// W^T (M / h^2) W of a free body, and its inverse.
    const MotionMatrix& matrix(std::size_t object) const { return bodies_[numbers_[object]].matrix; }
    const MotionMatrix& inverse(std::size_t object) const { return bodies_[numbers_[object]].inverse; }
    /// The rigid part of the velocities of a free body's nodes, by momentum and angular momentum [m/s],
    /// [rad/s].
    Motion velocity(std::size_t object, std::span<const Vec4<Real>> velocities) const;
    /// A motion where a node of a free body is.
    Vec3<Real> at(std::size_t node, std::span<const Motion> motions) const {
        return displacement(motions[body_of_[node]], arms_[node]);
    }
    /// The rigid part of displacements of a free body's nodes, by inertia. @param inertia as in begin()
    Motion rigid_part(std::size_t object, std::span<const Real> inertia,
                      std::span<const Vec3<Real>> displacements) const;
    /// Nothing but that is left of them.
    void make_rigid(std::size_t object, std::span<const Real> inertia,
                    std::span<Vec3<Real>> displacements) const;
    /// What a step of true rotations differs by from a linear one, d = s + w x r, to second order, for the
    /// rotation w that inertia wants: the displacements w x (w x r) / 2 are taken out, and forces rotate with
    /// their bodies.
    /// @param displacements that inertia wants [m] @param forces of elements [N]; both input and output
    void follow_rotation(std::span<const Vec4<Real>> positions, std::span<const Real> inertia,
                         std::span<Vec3<Real>> displacements, std::span<Vec3<Real>> forces);
    /// After it: w of a free body [rad].
    const glm::dvec3& wanted_rotation(std::size_t object) const { return bodies_[numbers_[object]].rotation; }
    /// And what those of soft bodies will add to s of a row [m].
    Vec3<Real> added_by_rotation(const ContactRow<Real>& row) const;

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
        glm::dvec3 rotation{0.0};  // w
    };

    std::shared_ptr<const Model> model_;
    std::vector<std::uint32_t> numbers_;  // of objects among the free bodies, or kNoNode
    std::vector<std::uint32_t> body_of_;  // of nodes, the same
    std::vector<Body> bodies_;
    std::vector<Vec3<Real>> arms_;  // of nodes, from their bodies' centres [m]
};

}  // namespace gelatin::cpu
