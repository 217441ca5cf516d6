#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cpu/descent/rigid_motion.h"

namespace gelatin::cpu {

/// How a body moves as a rigid one.
struct Twist {
    glm::dvec3 velocity{0.0}, spin{0.0};  ///< of the centre of mass [m/s]; [rad/s]

    /// @param arm from the centre of mass [m]
    glm::dvec3 at(const glm::dvec3& arm) const { return velocity + glm::cross(spin, arm); }
    Twist operator+(const Twist& other) const { return {velocity + other.velocity, spin + other.spin}; }
};

/// What a body as a rigid one has against impulses.
struct RigidInertia {
    glm::dvec3 center{0.0};     ///< from the origin of the sums [m]
    double inverse_mass = 0.0;  ///< [1/kg]
    /// About the centre [kg m^2], [1/(kg m^2)].
    glm::dmat3 inertia{0.0}, inverse_inertia{0.0};

    /// @param sums over its nodes, with masses for stiffnesses
    explicit RigidInertia(RigidSums sums)
        : center(sums.arm / sums.stiffness), inverse_mass(1.0 / sums.stiffness) {
        sums.square.add_outer(-sums.stiffness, center);
        const glm::dvec3 &d = sums.square.diagonal, &b = sums.square.beside;
        const double trace = d.x + d.y + d.z;
        constexpr double kThin = 1e-6;  // a row of nodes has no inertia about itself
        const glm::dvec3 own = (1.0 + kThin) * glm::dvec3(trace) - d;
        inertia = glm::dmat3(own.x, -b.z, -b.y, -b.z, own.y, -b.x, -b.y, -b.x, own.z);
        if (trace > 0.0) inverse_inertia = glm::inverse(inertia);
    }

    /// @param angular momentum about the origin
    Twist twist(const glm::dvec3& momentum, const glm::dvec3& angular) const {
        return {inverse_mass * momentum, inverse_inertia * (angular - glm::cross(center, momentum))};
    }
};

}  // namespace gelatin::cpu
