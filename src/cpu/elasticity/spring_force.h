#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// Force on endpoint a of the spring a-b [N]: k (l - rest_length + t l') towards b, with the damping time t
/// [s] and l' the rate of change of the length (damping along the spring: Nealen et al. 2006, eq. 5, with k_d
/// = k t). Coincident endpoints give zero, not NaN. GLSL twin: shaders/sim/elasticity/spring_force.glsl.
template <class Real>
Vec3<Real> spring_force(const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& velocity_a,
                        const Vec3<Real>& velocity_b, Real rest_length, Real stiffness, Real damping_time) {
    const Vec3<Real> d = b - a;
    const Real length_squared = std::max(glm::dot(d, d), Real(1e-30));
    const Real length = std::sqrt(length_squared);
    const Vec3<Real> n = d * (Real(1) / length);  // one division, not three
    const Real rate = glm::dot(velocity_b - velocity_a, n);
    return n * (stiffness * (length - rest_length + damping_time * rate));
}

/// The same with the damping time from the nodes' fourth components: a spring uses the mean of its two
/// nodes'.
template <class Real>
Vec3<Real> spring_force(const Vec4<Real>& a, const Vec4<Real>& b, const Vec4<Real>& velocity_a,
                        const Vec4<Real>& velocity_b, Real rest_length, Real stiffness) {
    return spring_force(Vec3<Real>(a), Vec3<Real>(b), Vec3<Real>(velocity_a), Vec3<Real>(velocity_b),
                        rest_length, stiffness, Real(0.5) * (velocity_a.w + velocity_b.w));
}

}  // namespace gelatin::cpu
