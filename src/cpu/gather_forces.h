#pragma once

#include "cpu/advance_nodes.h"
#include "cpu/spring_force.h"

namespace gelatin::cpu {

/// How far ahead of a node others are fetched into the cache: nodes of a small object are gathered from all
/// over it, of a large one from a narrower band.
constexpr std::uint32_t kNodesAhead = 4096;

/// The force of all springs of node n [N], in the order of its half springs.
template <class Real>
inline Vec3<Real> gather_forces(const Pass<Real>& pass, std::uint32_t n) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = pass.model.half_springs;
    const Vec4<Real> position = pass.positions[n];
    const Vec4<Real> velocity = pass.velocities[n];
    const auto force_of = [&](std::uint32_t other, float rest_length, float stiffness) {
        return spring_force<Real>(position, pass.positions[other], velocity, pass.velocities[other],
                                  rest_length, stiffness);
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

}  // namespace gelatin::cpu
