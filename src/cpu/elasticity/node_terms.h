#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

#include "cpu/nodes.h"
#include "model/shared_constants.h"

namespace gelatin::cpu {

/// a b + c
template <class T>
T multiply_add(const T& a, const T& b, const T& c) {
    return a * b + c;
}

template <class Real>
Real select(bool condition, Real a, Real b) {
    return condition ? a : b;
}

/// Below this fraction of its rest volume, a tet resists.
using thresholds::kFlattest;

#include "cpu/elasticity/node_terms.inl"

/// The spring to a node at the offset `apart` from this one. With l its length, n its direction, L the rest
/// length, k the stiffness, t the damping time, h the step and l_0 the length at the start of the step, the
/// damper
///   k t / (2 h) (l - l_0)^2
/// makes it a spring of stiffness K = k (1 + t / h) and rest length M = (L + t / h l_0) / (1 + t / h):
///   force   K (l - M) n
///   hessian K (n n^T + max(0, 1 - M / l) (1 - n n^T)).
/// The second term of the energy's own Hessian is negative where the spring is shorter than M, and is omitted
/// there. A spring of no length has no direction and adds nothing. @param damping t / h
template <class Real>
void add_spring(const Vec3<Real>& apart, Real start_length, Real rest_length, Real stiffness, Real damping,
                NodeTerms<Real>& terms) {
    const Real length = glm::length(apart);
    const Vec3<Real> n = length > Real(0) ? apart / length : Vec3<Real>(0);
    const Real damped = stiffness * (Real(1) + damping);
    const Real rest = (rest_length + damping * start_length) / (Real(1) + damping);
    terms.force += damped * (length - rest) * n;
    const Real across = length > rest ? damped * (Real(1) - rest / length) : Real(0);
    terms.hessian.add_outer(damped - across, n);
    terms.hessian.add_identity(across);
}

/// dJ/dx of a tet as seen from one of its corners [1/m].
/// @param face the other corners, counter-clockwise as seen from the corner
template <class Real>
Vec3<Real> volume_slope(const std::array<Vec3<Real>, 3>& face, Real rest_volume) {
    return glm::cross(face[1] - face[0], face[2] - face[0]) / (Real(6) * rest_volume);
}

/// kappa phi'(J - 1) of the volume term [Pa], with J the volume around a node relative to that at rest.
/// phi(u) = u^2 / 2 if kappa > 0. If it is negative, the term takes energy out of a body that grows, and must
/// be bounded: phi'(u) = u (1 - (u / a)^2)^2 up to |u| = a = 1/2, and 0 beyond.
template <class Real>
Real volume_stress(Real ratio, Real kappa) {
    const Real u = ratio - Real(1);
    if (kappa >= Real(0)) return kappa * u;
    const Real left = std::max(Real(1) - Real(4) * u * u, Real(0));
    return kappa * u * left * left;
}

/// matrix^-1 v by the square-root-free Cholesky decomposition; zero along directions without stiffness.
/// Pivots that are smaller than the rounding error of their operands count as zero stiffness: the result may
/// then be too short, never too long.
template <class Real>
Vec3<Real> solve(const SymmetricMatrix<Real>& matrix, const Vec3<Real>& v) {
    const auto inverse = [](Real pivot, Real diagonal) {
        const Real d = std::max(pivot, Real(8) * std::numeric_limits<Real>::epsilon() * diagonal);
        return d > Real(0) ? Real(1) / d : Real(0);
    };
    const Vec3<Real>&d = matrix.diagonal, &b = matrix.beside;
    const Real i0 = inverse(d.x, d.x);
    const Real l10 = b.z * i0, l20 = b.y * i0;
    const Real i1 = inverse(d.y - l10 * b.z, d.y);
    const Real rest = b.x - l20 * b.z, l21 = rest * i1;
    const Real i2 = inverse(d.z - l20 * b.y - l21 * rest, d.z);
    const Real y1 = v.y - l10 * v.x, y2 = v.z - l20 * v.x - l21 * y1;
    const Real z = y2 * i2, y = y1 * i1 - l21 * z;
    return {v.x * i0 - l10 * y - l20 * z, y, z};
}

/// A node's Newton step [m].
template <class Real>
Vec3<Real> solve(const NodeTerms<Real>& terms) {
    return solve(terms.hessian, terms.force);
}

}  // namespace gelatin::cpu
