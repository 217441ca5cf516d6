#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cpu/elasticity/node_terms.h"
#include "cpu/nodes.h"
#include "model/layouts.h"
#include "model/shared_constants.h"

/// Stable neo-Hookean tets (Smith, de Goes, Kim: "Stable Neo-Hookean Flesh Simulation", ACM Transactions on
/// Graphics 37(2), 2018). With F the deformation gradient, I = F : F, J = det F, the energy over the volume
/// at rest V is
///   W / V = mu/2 (I - 3 - log((I + 1) / 4)) - 3/4 mu (J - 1) + lambda/2 (J - 1)^2,
/// their eq. 14 except for a constant that makes it zero at rest. It is defined for flat and inverted tets,
/// and the rest shape is its only minimum. GLSL twin: shaders/sim/elasticity/neo_hookean.glsl.
namespace gelatin::cpu {

template <class Real>
using Mat3 = glm::mat<3, 3, Real>;

/// A tet with I = F : F below this is nearly a point. It has no stress that would open it, and no direction
/// to open in, so it gets the pressure mu in its rest orientation.
using thresholds::kCollapsed;

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

/// dJ/dF.
template <class Real>
Mat3<Real> cofactor(const Mat3<Real>& f) {
    return {glm::cross(f[1], f[2]), glm::cross(f[2], f[0]), glm::cross(f[0], f[1])};
}

/// I = F : F.
template <class Real>
Real sum_of_squares(const Mat3<Real>& f) {
    return glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
}

/// W / V [J/m^3].
template <class Real>
Real neo_hookean_energy(const Mat3<Real>& f, Real mu, Real lambda) {
    const Real squares = sum_of_squares(f), dilation = glm::dot(f[0], glm::cross(f[1], f[2])) - Real(1);
    return Real(0.5) * mu * (squares - Real(3) - std::log(Real(0.25) * (squares + Real(1)))) +
           (Real(0.5) * lambda * dilation - Real(0.75) * mu) * dilation;
}

/// The two factors of the stress dW/dF / V = shear F + pressure cof F [Pa].
template <class Real>
struct NeoHookeanStress {
    Real shear;     ///< mu I / (I + 1)
    Real pressure;  ///< lambda (J - 1) - 3/4 mu
    Real opening;   ///< minus the pressure that opens a collapsed tet: mu or 0

    NeoHookeanStress(Real squares, Real volume_ratio, Real mu, Real lambda)
        : shear(mu * squares / (squares + Real(1))),
          pressure(lambda * (volume_ratio - Real(1)) - Real(0.75) * mu),
          opening(squares < static_cast<Real>(kCollapsed) ? mu : Real(0)) {}
};

/// Viscous stress from the strain rate, with Lamé's moduli [Pa]: 2 mu_L E + lambda_L tr E, with mu_L = 3/4
/// mu, lambda_L = lambda - 5/8 mu, and sym(F^T change) the rate E of Green's strain. Rotation has no rate, so
/// it is not damped.
template <class Real>
Mat3<Real> viscous_stress(const Mat3<Real>& f, const Mat3<Real>& change, Real mu, Real lambda) {
    const Mat3<Real> product = glm::transpose(f) * change;
    const Mat3<Real> twice_strain = product + glm::transpose(product);
    const Real trace = product[0].x + product[1].y + product[2].z;
    return Real(0.75) * mu * twice_strain + Mat3<Real>((lambda - Real(0.625) * mu) * trace);
}

/// The factor on the damping of a stretched tet: 4 / (I + 1), 1 at rest. F S grows with the square of F,
/// elastic stress with F. Without it a relaxation that takes t at rest would take forever in a tet that is
/// stretched far.
template <class Real>
Real viscous_share(Real squares) {
    return Real(4) / (squares + Real(1));
}

/// The force of a tet on one of its corners [N]: -V (dW/dF / V + t a F S) g with the damping time t, the
/// viscous share a, the viscous stress S for dF/dt, and the corner's shape gradient g.
template <class Real>
Vec3<Real> neo_hookean_force(const NeoHookeanTet& tet, std::uint32_t corner, const Vec4<Real>* positions,
                             const Vec4<Real>* velocities) {
    const Real volume = static_cast<Real>(tet.gradient_1.w), mu = static_cast<Real>(tet.gradient_2.w),
               lambda = static_cast<Real>(tet.gradient_3.w);
    const Vec3<Real> g = shape_gradient<Real>(tet, corner);
    const Mat3<Real> f = gradient_of(tet, at_corners(tet, positions));
    const Mat3<Real> cofactors = cofactor(f);
    const Real squares = sum_of_squares(f);
    const NeoHookeanStress<Real> stress(squares, glm::dot(f[0], cofactors[0]), mu, lambda);
    Vec3<Real> traction = stress.shear * (f * g) + stress.pressure * (cofactors * g) - stress.opening * g;
    const Real damping_time = mean_damping_time(tet, velocities);
    if (damping_time > Real(0)) {
        const Mat3<Real> rate = gradient_of(tet, at_corners(tet, velocities));
        traction += damping_time * viscous_share(squares) * (f * (viscous_stress(f, rate, mu, lambda) * g));
    }
    return -volume * traction;
}

#include "cpu/elasticity/neo_hookean_terms.inl"

/// @param g the corner's shape gradient
template <class Real>
TetAtCorner<Real> tet_at_corner(const Vec3<Real>& g, const Mat3<Real>& f) {
    const Mat3<Real> cofactors = cofactor(f);
    return {f * g, cofactors * g, sum_of_squares(f), glm::dot(f[0], cofactors[0]), glm::dot(g, g)};
}

/// mu V and lambda V.
template <class Real>
TetModuli<Real> tet_moduli(const NeoHookeanTet& tet) {
    const auto volume = static_cast<Real>(tet.gradient_1.w);
    return {volume * static_cast<Real>(tet.gradient_2.w), volume * static_cast<Real>(tet.gradient_3.w)};
}

/// The force that opens a collapsed tet, at a corner with the shape gradient g [N].
template <class Real>
Vec3<Real> opening_force(const Vec3<Real>& g, Real squares, Real mu) {
    return squares < static_cast<Real>(kCollapsed) ? mu * g : Vec3<Real>(0);
}

}  // namespace gelatin::cpu
