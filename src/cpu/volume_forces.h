#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>

#include "cpu/node_terms.h"
#include "cpu/nodes.h"
#include "model/model.h"

/// The volume term (model/volume_term.h) as it is, not as block descent bounds it (cpu/node_terms.h). GLSL
/// twin: shaders/include/volume_term.glsl.
namespace gelatin::cpu {

/// phi(J - 1), whose slope is volume_stress over kappa.
template <class Real>
Real volume_potential(Real ratio, Real kappa) {
    const Real u = ratio - Real(1);
    if (kappa >= Real(0)) return Real(0.5) * u * u;
    const Real s = std::min(Real(4) * u * u, Real(1));
    return s * (Real(3) - Real(3) * s + s * s) / Real(24);
}

/// Calls `work` with each tet round node n as its corner there sees it. Rows are padded with tets without
/// volume.
template <class Work>
void for_tets_round(const VolumeTerm& term, std::uint32_t n, const Work& work) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const TetCorners& corners = term.corners;
    const std::uint32_t start = corners.slice_starts[n / kSlice], end = corners.slice_starts[n / kSlice + 1];
    for (std::uint32_t e = start + n % kSlice; e < end; e += kSlice) work(corners.corners[e]);
}

/// J_n: the volume round node n over that at rest; 1 where there is none.
/// @param position of a node, as a Vec3<Real>
template <class Real, class Position>
Real volume_ratio_round(const VolumeTerm& term, std::uint32_t n, const Position& position) {
    const auto rest = static_cast<Real>(term.nodes[n].x);
    if (!(rest > Real(0))) return Real(1);
    const Vec3<Real> at = position(n);
    Real sum(0);  // 24 times the volume
    for_tets_round(term, n, [&](const TetCorner& tet) {
        const Vec3<Real> a = position(tet.a);
        sum += glm::dot(at - a, glm::cross(position(tet.b) - a, position(tet.c) - a));
    });
    return sum / (Real(24) * rest);
}

}  // namespace gelatin::cpu
