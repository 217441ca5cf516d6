#pragma once

#include <array>
#include <cstdint>
#include <glm/matrix.hpp>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/elasticity/neo_hookean.h"

/// Neo-Hookean tets of a model, with the formulas of cpu/elasticity/neo_hookean.inl.
namespace gelatin::cpu {

/// The gradient of a corner's shape function at rest [1/m].
template <class Real>
Vec3<Real> shape_gradient(const NeoHookeanTet& tet, std::uint32_t corner) {
    const Vec3<Real> g1(tet.gradient_1), g2(tet.gradient_2), g3(tet.gradient_3);
    switch (corner) {
        case 1:
            return g1;
        case 2:
            return g2;
        case 3:
            return g3;
        default:
            return -(g1 + g2 + g3);
    }
}

/// The gradient, over the rest shape, of a field with these values at the corners: F for positions, dF/dt for
/// velocities.
template <class Real>
Mat3<Real> gradient_of(const NeoHookeanTet& tet, const std::array<Vec3<Real>, 4>& values) {
    return glm::outerProduct(values[1] - values[0], Vec3<Real>(tet.gradient_1)) +
           glm::outerProduct(values[2] - values[0], Vec3<Real>(tet.gradient_2)) +
           glm::outerProduct(values[3] - values[0], Vec3<Real>(tet.gradient_3));
}

template <class Real>
std::array<Vec3<Real>, 4> at_corners(const NeoHookeanTet& tet, const Vec4<Real>* values) {
    return {Vec3<Real>(values[tet.node_0]), Vec3<Real>(values[tet.node_1]), Vec3<Real>(values[tet.node_2]),
            Vec3<Real>(values[tet.node_3])};
}

/// The damping time of a tet [s]: the mean of its corners', which velocity.w stores.
template <class Real>
Real mean_damping_time(const NeoHookeanTet& tet, const Vec4<Real>* velocities) {
    return Real(0.25) * (velocities[tet.node_0].w + velocities[tet.node_1].w + velocities[tet.node_2].w +
                         velocities[tet.node_3].w);
}

/// mu V and lambda V.
template <class Real>
TetModuli<Real> tet_moduli(const NeoHookeanTet& tet) {
    const auto volume = static_cast<Real>(tet.gradient_1.w);
    return {volume * static_cast<Real>(tet.gradient_2.w), volume * static_cast<Real>(tet.gradient_3.w)};
}

/// The force of a tet and its viscosity on one of its corners [N].
template <class Real>
Vec3<Real> neo_hookean_force(const NeoHookeanTet& tet, std::uint32_t corner, const Vec4<Real>* positions,
                             const Vec4<Real>* velocities) {
    const TetModuli<Real> moduli = tet_moduli<Real>(tet);
    const Vec3<Real> g = shape_gradient<Real>(tet, corner);
    const Mat3<Real> f = gradient_of(tet, at_corners(tet, positions));
    const TetAtCorner<Real> at_corner = tet_at_corner<Real>(g, f);
    Vec3<Real> force = neo_hookean_force(at_corner, moduli) + opening_force(g, at_corner.squares, moduli.mu);
    const Real damping_time = mean_damping_time(tet, velocities);
    if (damping_time > Real(0)) {
        const Mat3<Real> rate = gradient_of(tet, at_corners(tet, velocities));
        force += viscous_force(g, f, rate, moduli, damping_time);
    }
    return force;
}

}  // namespace gelatin::cpu
