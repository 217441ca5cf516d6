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

    RigidInertia() = default;
    /// @param sums over its nodes, with masses for stiffnesses
    explicit RigidInertia(RigidSums sums)
        : center(sums.arm / sums.stiffness), inverse_mass(1.0 / sums.stiffness) {
        sums.square.add_outer(-sums.stiffness, center);
        const glm::dvec3& d = sums.square.diagonal;
        inertia = full(inertia_of(sums.square));
        if (d.x + d.y + d.z > 0.0) inverse_inertia = glm::inverse(inertia);
    }

    /// [J]
    double energy(const Twist& twist) const {
        return 0.5 * (glm::dot(twist.velocity, twist.velocity) / inverse_mass +
                      glm::dot(twist.spin, inertia * twist.spin));
    }

    /// @param angular momentum about the origin
    Twist twist(const glm::dvec3& momentum, const glm::dvec3& angular) const {
        return {inverse_mass * momentum, inverse_inertia * (angular - glm::cross(center, momentum))};
    }
};

}  // namespace gelatin::cpu
