#pragma once

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/descent/descent_rows.h"

namespace gelatin::cpu {

/// What block descent gathers from springs.
template <class Real>
struct SpringRows {
    const DescentRows& rows;
    const Vec4<Real>* positions;  ///< xyz [m], shape [nodes]
    const Vec4<Real>* starts;     ///< xyz when the step began [m], damping time [s], shape [nodes]
    Real inverse_step;            ///< [1/s]
};

/// One spring's, from the row's node to `other`.
template <class Real>
void add_row_spring(const SpringRows<Real>& from, std::uint32_t node, std::uint32_t other, float rest_length,
                    float stiffness, NodeTerms<Real>& terms) {
    const Vec4<Real>&position = from.positions[node], &other_position = from.positions[other];
    const Vec4<Real>&start = from.starts[node], &other_start = from.starts[other];
    const Real damping = Real(0.5) * (start.w + other_start.w) * from.inverse_step;
    const Real start_length = glm::distance(Vec3<Real>(other_start), Vec3<Real>(start));
    const SpringLaw<Real> spring{static_cast<Real>(rest_length), static_cast<Real>(stiffness)};
    add_spring(Vec3<Real>(other_position - position), damped_spring(spring, start_length, damping), terms);
}

/// Adds the terms of all springs of the node in row `row`.
template <class Real>
void add_row_springs(const SpringRows<Real>& from, std::uint32_t row, NodeTerms<Real>& terms) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = from.rows.springs;
    const std::uint32_t node = from.rows.nodes[row], slice = row / kSlice;
    for (std::uint32_t p = springs.slice_starts[slice] + row % kSlice; p < springs.slice_starts[slice + 1];
         p += kSlice) {
        const HalfSpringPair& pair = springs.pairs[p];
        const glm::vec2& stiffness = springs.stiffness[p];
        if (stiffness.x > 0.0f)
            add_row_spring(from, node, pair.node_0, pair.rest_length_0, stiffness.x, terms);
        if (stiffness.y > 0.0f)
            add_row_spring(from, node, pair.node_1, pair.rest_length_1, stiffness.y, terms);
    }
}

}  // namespace gelatin::cpu
