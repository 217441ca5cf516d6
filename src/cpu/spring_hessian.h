#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "cpu/nodes.h"

namespace gelatin::cpu {

template <class Real>
using Mat3 = glm::mat<3, 3, Real>;

/// What one element of a body adds to a node's part of the objective of a step: minus its gradient, which is
/// a force [N], and a positive semi-definite second derivative [N/m].
template <class Real>
struct NodeTerms {
    Vec3<Real> force{0};
    Mat3<Real> hessian{0};
};

/// A direction for two nodes in one place, which pushes them apart: not the same for all pairs, and opposite
/// as the other one sees it.
template <class Real>
Vec3<Real> any_direction(std::uint32_t node, std::uint32_t other) {
    const std::uint32_t low = std::min(node, other), high = std::max(node, other);
    std::uint32_t bits = low * 0x9E3779B9u ^ high * 0x85EBCA6Bu;
    const auto next = [&] {
        bits ^= bits << 13;
        bits ^= bits >> 17;
        bits ^= bits << 5;
        return static_cast<Real>(static_cast<std::int32_t>(bits & 0xFFFFu) - 0x8000) / Real(0x8000);
    };
    const Real x = next(), y = next(), z = next();
    const Vec3<Real> v(x, y, z + Real(0.01));
    return (node < other ? Real(1) : Real(-1)) * glm::normalize(v);
}

/// The spring from a node at `position` to `other`, with n from one to the other, l their distance, L the
/// rest length, k the stiffness, t the damping time, h the step and l' the rate of the length over the step:
///   force   k (l - L + t l') n
///   hessian k (n n^T + max(0, 1 - L / l) (1 - n n^T)) + k t / h n n^T
/// The second term of the energy's own Hessian is negative where the spring is shorter than at rest, and is
/// left out there. Source: docs/physics.md. GLSL twin: shaders/include/spring_hessian.glsl.
/// @param way, other_way of the two in the step so far [m] @param damping t / h
template <class Real>
void add_spring(const Vec3<Real>& position, const Vec3<Real>& other, const Vec3<Real>& way,
                const Vec3<Real>& other_way, const Vec3<Real>& if_coincident, Real rest_length,
                Real stiffness, Real damping, NodeTerms<Real>& terms) {
    const Vec3<Real> d = other - position;
    const Real length = glm::length(d);
    const Vec3<Real> n = length > Real(0) ? d / length : if_coincident;
    const Real rate = glm::dot(other_way - way, n);
    terms.force += stiffness * (length - rest_length + damping * rate) * n;
    const Real across = length > rest_length ? stiffness * (Real(1) - rest_length / length) : Real(0);
    const Real along = stiffness * (Real(1) + damping) - across;
    terms.hessian += along * glm::outerProduct(n, n);
    for (int k = 0; k < 3; ++k) terms.hessian[k][k] += across;
}

/// hessian^-1 force by the square-root-free Cholesky decomposition; zero along what has no stiffness.
template <class Real>
Vec3<Real> solve(const NodeTerms<Real>& terms) {
    const Mat3<Real>& h = terms.hessian;
    const auto inverse = [](Real d) { return d > Real(0) ? Real(1) / d : Real(0); };
    const Real d0 = h[0][0], i0 = inverse(d0);
    const Real l10 = h[0][1] * i0, l20 = h[0][2] * i0;
    const Real d1 = h[1][1] - l10 * l10 * d0, i1 = inverse(d1);
    const Real l21 = (h[1][2] - l20 * l10 * d0) * i1;
    const Real i2 = inverse(h[2][2] - l20 * l20 * d0 - l21 * l21 * d1);
    const Real y0 = terms.force.x, y1 = terms.force.y - l10 * y0, y2 = terms.force.z - l20 * y0 - l21 * y1;
    const Real x2 = y2 * i2;
    const Real x1 = y1 * i1 - l21 * x2;
    return {y0 * i0 - l10 * x1 - l20 * x2, x1, x2};
}

}  // namespace gelatin::cpu
