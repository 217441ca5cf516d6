#pragma once

#include <cstdint>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/model.h"

/// The volume term (model/elasticity/volume_term.h). GLSL twins: shaders/sim/elasticity/volume_term.glsl,
/// volume_force.glsl.
namespace gelatin::cpu {

/// J_n: the volume around node n relative to that at rest; 1 if there is none.
/// @param position of a node, as a Vec3<Real>
template <class Real, class Position>
Real volume_ratio_round(const VolumeTerm& term, std::uint32_t n, const Position& position) {
    const auto rest = static_cast<Real>(term.nodes[n].x);
    if (!(rest > Real(0))) return Real(1);
    const Vec3<Real> at = position(n);
    Real sum(0);  // 24 times the volume
    term.corners.for_row(n, [&](const TetCorner& tet) {
        const Vec3<Real> a = position(tet.a);
        sum += glm::dot(at - a, glm::cross(position(tet.b) - a, position(tet.c) - a));
    });
    return sum / (Real(24) * rest);
}

/// p_n = kappa phi'(J_n - 1) [Pa].
template <class Real>
Real volume_stress_round(const VolumeTerm& term, std::uint32_t n, const Vec4<Real>* positions) {
    const Real ratio =
        volume_ratio_round<Real>(term, n, [&](std::uint32_t k) { return Vec3<Real>(positions[k]); });
    return volume_stress(ratio, static_cast<Real>(term.nodes[n].y));
}

}  // namespace gelatin::cpu
