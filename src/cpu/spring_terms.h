#pragma once

#include "cpu/node_terms.h"
#include "cpu/nodes.h"
#include "model/descent_rows.h"

namespace gelatin::cpu {

/// What block descent gathers from springs.
template <class Real>
struct SpringRows {
    const DescentRows& rows;
    const Vec4<Real>* positions;  ///< xyz [m], shape [nodes]
    const Vec4<Real>* starts;     ///< xyz when the step began [m], damping time [s], shape [nodes]
    Real inverse_step;            ///< [1/s]
};

/// The terms of all springs of each node in slice `slice` of the rows; zero where a row has none.
/// @param terms shape [HalfSprings::kSlice]
template <class Real>
void gather_spring_terms(const SpringRows<Real>& from, std::uint32_t slice, NodeTerms<Real>* terms);

/// The same in float with SIMD, for the processor it runs on; differs from the plain one by rounding alone.
void gather_spring_terms_simd(const SpringRows<float>& from, std::uint32_t slice, NodeTerms<float>* terms);

/// One spring's, from the row's node to `other`.
template <class Real>
void add_row_spring(const SpringRows<Real>& from, std::uint32_t node, std::uint32_t other, float rest_length,
                    float stiffness, NodeTerms<Real>& terms) {
    const Vec4<Real>&position = from.positions[node], &other_position = from.positions[other];
    const Vec4<Real>&start = from.starts[node], &other_start = from.starts[other];
    const Real damping = Real(0.5) * (start.w + other_start.w) * from.inverse_step;
    const Real start_length = glm::distance(Vec3<Real>(other_start), Vec3<Real>(start));
    add_spring(Vec3<Real>(other_position - position), any_direction<Real>(node), start_length,
               static_cast<Real>(rest_length), static_cast<Real>(stiffness), damping, terms);
}

}  // namespace gelatin::cpu
