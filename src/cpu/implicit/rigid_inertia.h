#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

/// Sums over nodes at r from a body's origin [m], that forces f [N] act on, and whose displacement is
/// resisted alike in all directions by stiffnesses k [N/m], or whose masses these are.
struct RigidSums {
    double stiffness = 0.0;          ///< sum k
    glm::dvec3 arm{0.0};             ///< sum k r
    SymmetricMatrix<double> square;  ///< sum k r r^T
    glm::dvec3 force{0.0}, moment{0.0};

    void add(const glm::dvec3& r, double k, const glm::dvec3& f) {
        stiffness += k;
        arm += k * r;
        square.add_outer(k, r);
        force += f;
        moment += glm::cross(r, f);
    }
};

inline glm::dmat3 full(const SymmetricMatrix<double>& m) {
    return {m.diagonal.x, m.beside.z, m.beside.y, m.beside.z,  m.diagonal.y,
            m.beside.x,   m.beside.y, m.beside.x, m.diagonal.z};
}

/// How much a body resists rotations: sum k (r^2 - r r^T). A row of nodes, which does not resist one about
/// itself, gets a little; nodes in one point, which no rotation moves, any. @param square sum k r r^T
inline SymmetricMatrix<double> inertia_of(const SymmetricMatrix<double>& square) {
    constexpr double kThin = 1e-6;
    const double trace = square.diagonal.x + square.diagonal.y + square.diagonal.z;
    if (!(trace > 0.0)) return {glm::dvec3(1.0), glm::dvec3(0.0)};
    return {(1.0 + kThin) * glm::dvec3(trace) - square.diagonal, -square.beside};
}

/// How a body moves as a rigid one.
struct Twist {
    glm::dvec3 velocity{0.0}, spin{0.0};  ///< of the centre of mass [m/s]; [rad/s]

    /// @param arm from the centre of mass [m]
    glm::dvec3 at(const glm::dvec3& arm) const { return velocity + glm::cross(spin, arm); }
};

/// What a body as a rigid one has against impulses.
struct RigidInertia {
    glm::dvec3 center{0.0};           ///< from the origin of the sums [m]
    double inverse_mass = 0.0;        ///< [1/kg]
    glm::dmat3 inverse_inertia{0.0};  ///< about the centre [1/(kg m^2)]

    RigidInertia() = default;
    /// @param sums over its nodes, with masses for stiffnesses
    explicit RigidInertia(RigidSums sums)
        : center(sums.arm / sums.stiffness), inverse_mass(1.0 / sums.stiffness) {
        sums.square.add_outer(-sums.stiffness, center);
        inverse_inertia = glm::inverse(full(inertia_of(sums.square)));
    }

    /// @param angular momentum about the origin
    Twist twist(const glm::dvec3& momentum, const glm::dvec3& angular) const {
        return {inverse_mass * momentum, inverse_inertia * (angular - glm::cross(center, momentum))};
    }
};

}  // namespace gelatin::cpu
