#pragma once

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/elasticity/spring_force.h"
#include "cpu/elasticity/volume_term.h"
#include "cpu/explicit/advance_nodes.h"

namespace gelatin::cpu {

/// How far ahead of a node other nodes are prefetched: nodes of a small object gather from all of it, nodes
/// of a large one from a narrower band.
constexpr std::uint32_t kNodesAhead = 4096;

/// The force of all neo-Hookean tets of node n [N], in their order.
template <class Real>
inline Vec3<Real> gather_tet_forces(const Pass<Real>& pass, std::uint32_t n) {
    const Model& model = pass.model;
    Vec3<Real> force(0);
    if (model.neo_hookean_tets.empty()) return force;
    const NodeTets& corners = model.neo_hookean_corners;
    for (std::uint32_t e = corners.starts[n]; e < corners.starts[n + 1]; ++e) {
        const std::uint32_t entry = corners.entries[e];
        force +=
            neo_hookean_force(model.neo_hookean_tets[entry / 4], entry % 4, pass.positions, pass.velocities);
    }
    return force;
}

/// The force of all springs of node n [N], in the order of its half springs.
template <class Real>
inline Vec3<Real> gather_spring_forces(const Pass<Real>& pass, std::uint32_t n) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = pass.model.half_springs;
    const auto force_of = [&](std::uint32_t other, float rest_length, float stiffness) {
        return spring_force(pass.positions, pass.velocities, n, other, rest_length, stiffness);
    };
    Vec3<Real> force(0);
    const std::uint32_t start = springs.slice_starts[n / kSlice], end = springs.slice_starts[n / kSlice + 1];
    for (std::uint32_t p = start + n % kSlice; p < end; p += kSlice) {
        const HalfSpringPair& pair = springs.pairs[p];
        force += force_of(pair.node_0, pair.rest_length_0, springs.stiffness[p].x);
        force += force_of(pair.node_1, pair.rest_length_1, springs.stiffness[p].y);
    }
    return force;
}

/// The term's force on node n [N]: each tet of volume v acts with -p dv/dx, p the mean stress of its corners.
template <class Real>
Vec3<Real> gather_volume_forces(const Pass<Real>& pass, std::uint32_t n) {
    Vec3<Real> sum(0);  // -24 times the force
    if (pass.volume_stresses == nullptr) return sum;
    pass.model.volume_term.corners.for_row(n, [&](const TetCorner& tet) {
        const Vec3<Real> a(pass.positions[tet.a]), b(pass.positions[tet.b]), c(pass.positions[tet.c]);
        const Real* p = pass.volume_stresses;
        sum += (p[n] + p[tet.a] + p[tet.b] + p[tet.c]) * glm::cross(b - a, c - a);
    });
    return Real(-1) / Real(24) * sum;
}

/// The elastic force on node n [N].
template <class Real>
inline Vec3<Real> gather_forces(const Pass<Real>& pass, std::uint32_t n) {
    return gather_spring_forces(pass, n) + gather_tet_forces(pass, n) + gather_volume_forces(pass, n);
}

}  // namespace gelatin::cpu
