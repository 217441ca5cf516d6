#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

/// A motion of a body that keeps its shape: x becomes center + translation + rotation (x - center).
struct RigidMotion {
    glm::dvec3 center{0.0}, translation{0.0};  ///< [m]
    glm::dmat3 rotation{1.0};

    glm::dvec3 move(const glm::dvec3& x) const { return center + translation + rotation * (x - center); }
};

/// The rotation about w by 2 atan(|w| / 2), which is |w| to third order: Cayley's 1 + 4 / (4 + w^2) (W + W^2
/// / 2) with W x = w x x. Less than 180 degrees for any w.
inline glm::dmat3 cayley_rotation(const glm::dvec3& w) {
    const glm::dmat3 cross(glm::dvec3(0.0, w.z, -w.y), glm::dvec3(-w.z, 0.0, w.x),
                           glm::dvec3(w.y, -w.x, 0.0));
    return glm::dmat3(1.0) + 4.0 / (4.0 + glm::dot(w, w)) * (cross + 0.5 * cross * cross);
}

/// Sums over nodes at r from a body's origin [m], that forces f [N] act on, and whose displacement is
/// resisted alike in all directions by stiffnesses k [N/m]: inertia, and friction.
struct RigidSums {
    double stiffness = 0.0;          ///< sum k
    glm::dvec3 arm{0.0};             ///< sum k r
    SymmetricMatrix<double> square;  ///< sum k r r^T
    glm::dvec3 force{0.0}, moment{0.0};

    void add(const glm::dvec3& r, double k, const glm::dvec3& f);
    /// @param factor times these
    void add(const RigidSums& other, double factor = 1.0);
};

inline glm::dmat3 full(const SymmetricMatrix<double>& m) {
    return {m.diagonal.x, m.beside.z, m.beside.y, m.beside.z,  m.diagonal.y,
            m.beside.x,   m.beside.y, m.beside.x, m.diagonal.z};
}

/// How much a body resists rotations: sum k (r^2 - r r^T). A row of nodes, which does not resist one about
/// itself, gets a little. @param square sum k r r^T
inline SymmetricMatrix<double> inertia_of(const SymmetricMatrix<double>& square) {
    constexpr double kThin = 1e-6;
    const double trace = square.diagonal.x + square.diagonal.y + square.diagonal.z;
    return {(1.0 + kThin) * glm::dvec3(trace) - square.diagonal, -square.beside};
}

/// How a surface holds a node: presses it with a force along its normal, which falls by `along` as the node
/// comes away, and holds it back with friction, which falls by `across` as the node slides back.
struct RigidContact {
    glm::dvec3 normal{0.0};  ///< unit
    double pressing = 0.0;   ///< [N]
    glm::dvec3 friction{0.0};
    double along = 0.0, across = 0.0;  ///< [N/m]; alike where the surface does not let it slide
};

/// Newton's step of a body along rigid motions, by a translation s and a rotation w: node i goes s + w x r_i,
/// which changes what acts on it by its stiffness times that. Internal forces do no work on it.
///   sum_i J_i^T K_i J_i (s, w) = sum_i J_i^T f_i,   J_i (s, w) = s + w x r_i
/// Friction of nodes that slide is taken times what that leaves of all pressing forces, of which few sweeps
/// find far too much in stiff bodies.
class RigidStep {
public:
    void add(const glm::dvec3& r, double stiffness, const glm::dvec3& force) {
        sums_.add(r, stiffness, force);
    }
    void add(const RigidSums& nodes) { sums_.add(nodes); }
    void add(const glm::dvec3& r, const RigidContact& contact);

    /// @pre some stiffness was added
    RigidMotion solve(const glm::dvec3& origin) const;

private:
    struct Displacement {
        glm::dvec3 translation, rotation;
    };
    void add_along(const glm::dvec3& r, const glm::dvec3& normal, double stiffness);
    Displacement displacement(const RigidSums& sums) const;

    RigidSums sums_, sliding_;  // sliding: the friction of nodes that slide
    // Of surfaces, sum k (n, r x n) (n, r x n)^T in blocks.
    SymmetricMatrix<double> translations_, rotations_;
    glm::dmat3 mixed_{0.0};
    // All that surfaces press with, and how it falls by a translation and a rotation: sum k n, sum k r x n.
    double pressing_ = 0.0;
    glm::dvec3 pressing_translation_{0.0}, pressing_rotation_{0.0};
};

}  // namespace gelatin::cpu
