#pragma once

#include "cpu/elasticity/elements.h"

// How two surfaces press each other that are nearer than a distance r (docs/contact.md): a spring that is
// stiff from the start, and a barrier below half of r. With k the stiffness, for a gap g:
//   from r on         nothing;
//   from r / 2 to r   energy k / 2 (r - g)^2;
//   below             k r^2 / 8 (1 + 2 ln(r / (2 g))), whose force k r^2 / (4 g) has no bound.
// The force and its derivative are continuous. The energy is convex.

namespace gelatin::cpu {

/// Of a gap that rounding has left without any, one that is this much of r is taken.
template <class Real>
Real contact_gap(Real gap, Real reach) {
    return larger(gap, Real(1e-4f) * reach);
}

/// [J]
template <class Real>
Real contact_energy(Real gap, Real reach, Real stiffness) {
    const Real depth = larger(reach - gap, Real(0));
    const Real barrier = Real(0.125f) * reach * reach *
                         (Real(1) + Real(2) * logarithm(reach / (Real(2) * contact_gap(gap, reach))));
    return stiffness * select(gap < Real(0.5f) * reach, barrier, Real(0.5f) * depth * depth);
}

/// Minus the slope of the energy by the gap [N].
template <class Real>
Real contact_force(Real gap, Real reach, Real stiffness) {
    const Real depth = larger(reach - gap, Real(0));
    const Real barrier = Real(0.25f) * reach * reach / contact_gap(gap, reach);
    return stiffness * select(gap < Real(0.5f) * reach, barrier, depth);
}

/// The second derivative of the energy by the gap [N/m].
template <class Real>
Real contact_hessian(Real gap, Real reach, Real stiffness) {
    const Real least = contact_gap(gap, reach);
    const Real barrier = Real(0.25f) * reach * reach / (least * least);
    const Real spring = select(gap < reach, Real(1), Real(0));
    return stiffness * select(gap < Real(0.5f) * reach, barrier, spring);
}

}  // namespace gelatin::cpu
