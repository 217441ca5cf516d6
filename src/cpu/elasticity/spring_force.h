#pragma once

#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

/// The force on node i of its spring to node j [N], damped for the mean of the nodes' damping times, which
/// velocities.w stores.
/// `inline`, since g++ else calls it for each spring from files compiled together.
/// @param positions, velocities shape [nodes]
template <class Real>
inline Vec3<Real> spring_force(const Vec4<Real>* positions, const Vec4<Real>* velocities, std::uint32_t i,
                               std::uint32_t j, float rest_length, float stiffness) {
    const Vec4<Real>&position = positions[i], &other_position = positions[j];
    const Vec4<Real>&velocity = velocities[i], &other_velocity = velocities[j];
    const Vec3<Real> apart(other_position - position);
    return spring_pull<Real>(apart, Vec3<Real>(other_velocity - velocity),
                             {static_cast<Real>(rest_length), static_cast<Real>(stiffness)},
                             Real(0.5) * (velocity.w + other_velocity.w)) *
           apart;
}

}  // namespace gelatin::cpu
