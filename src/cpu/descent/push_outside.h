#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cpu/collision/colliders.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

/// A node that has slid on a plane without friction, and what it resists with, to second order.
template <class Real>
struct Slip {
    glm::vec<2, Real> way;       ///< since the step began, along the plane [m]
    Vec3<Real> stiffness;        ///< K within the plane: xx, xy, yy [N/m]
    Real pressing;               ///< after that way [N]
    glm::vec<2, Real> coupling;  ///< how much more it presses, by a way along the plane [N/m]
};

/// What Coulomb's friction makes of it.
template <class Real>
struct Friction {
    glm::vec<2, Real> force{0};  ///< against the slip [N]
    glm::vec<2, Real> back{0};   ///< where the node goes [m]
    Real pressing = 0;           ///< there [N]
    Real yielding = 0;           ///< what is left of the slip, by the force [m/N]; 0 where friction holds
};

/// Finds the force f = K (way - left), of at most c times what presses, that acts along `left`, where
/// anything is left. So (I + y K) f = K way with the least y >= 0, and left = y f: a trust region problem
/// (More and Sorensen 1983), but that its bound depends on f, too. Newton's steps on the bound over |f|,
/// which is nearly linear in y, take two to six to 1e-5.
template <class Real>
Friction<Real> friction_on(const Slip<Real>& slip, Real c) {
    using Vector = glm::vec<2, Real>;
    constexpr int kRounds = 6;
    constexpr Real kEnough = Real(1e-5);
    const auto times = [](const Vec3<Real>& m, const Vector& v) {
        return Vector(m.x * v.x + m.y * v.y, m.y * v.x + m.z * v.y);
    };
    const auto inverse = [](const Vec3<Real>& m) {
        return Vec3<Real>(m.z, -m.y, m.x) / (m.x * m.z - m.y * m.y);
    };
    const auto yields = [&](Real y) { return inverse(Vec3<Real>(1, 0, 1) + y * slip.stiffness); };
    const Vector holding = times(slip.stiffness, slip.way);
    const Vector relieving = times(inverse(slip.stiffness), slip.coupling);  // of what presses, by f
    // Of less force, y is lost in rounding.
    const Real way = glm::length(slip.way), least = Real(1e-6) * glm::length(holding);
    Friction<Real> found{.force = holding};
    Real& y = found.yielding;
    Real length = glm::length(holding), most = 0;
    for (int round = 0;; ++round) {
        const Real pressing = slip.pressing - glm::dot(relieving, found.force);
        found.pressing = std::max(Real(0), pressing);
        most = std::max(c * found.pressing, least);
        const bool holds = y == Real(0) && length <= most;
        if (holds || std::abs(length - most) <= kEnough * most || round == kRounds) break;
        // Less than nothing where so strong a friction would lift the node.
        const Real bound = pressing > Real(0) ? most : c * pressing;
        const Vector falls = times(yields(y), times(slip.stiffness, found.force));
        const Real slope =
            bound * glm::dot(found.force, falls) / (length * length) + c * glm::dot(relieving, falls);
        y = slope > Real(0) ? y + (length - bound) / slope : Real(2) * y + way / (c * slip.pressing);
        y = std::clamp(y, Real(0), way / least);
        found.force = times(yields(y), holding);
        length = glm::length(found.force);
    }
    if (length > most) found.force *= most / length;
    found.back = y * found.force - slip.way;
    return found;
}

/// Takes a node that a Newton step has put inside a collider to where its part of the objective, to second
/// order, is least outside the collider's tangent plane: the normal force is what that takes. Friction then
/// takes back what the node has slid along the plane, with as much force as Coulomb's law allows.
/// GLSL twin: sim/descent/descend.comp.
/// @param start of the step [m] @param hessian of the node's part [N/m]
/// @param position input and output [m] @param contact the forces of colliders so far, and of this one
/// @return whether the node was inside
template <class Real>
bool push_outside(const Collider& collider, const Vec3<Real>& start, const SymmetricMatrix<Real>& hessian,
                  Vec3<Real>& position, ColliderContact<Real>& contact) {
    const SurfaceDistance<Real> surface = surface_distance(collider, position);
    if (surface.distance >= Real(0)) return false;
    const Vec3<Real>& n = surface.normal;
    const Vec3<Real> yielding = solve(hessian, n);  // to a force along n
    const Real compliance = glm::dot(n, yielding);
    if (!(compliance > Real(0))) {  // lost in rounding
        position -= surface.distance * n;
        return false;
    }
    const Real stiffness = Real(1) / compliance;
    const Real pressing = -surface.distance * stiffness;
    position += pressing * yielding;
    contact.normal = n;
    contact.along = stiffness;
    contact.across = Real(0);
    if (!(collider.friction > 0.0f)) {
        contact.force += pressing * n;
        return true;
    }
    const Vec3<Real> u =
        glm::normalize(glm::cross(n, std::abs(n.x) < Real(0.5) ? Vec3<Real>(1, 0, 0) : Vec3<Real>(0, 1, 0)));
    const Vec3<Real> v = glm::cross(n, u), of_u = hessian * u, of_v = hessian * v;
    const Vec3<Real> displacement = position - start;
    const Friction<Real> friction =
        friction_on<Real>({.way = {glm::dot(u, displacement), glm::dot(v, displacement)},
                           .stiffness = {glm::dot(u, of_u), glm::dot(u, of_v), glm::dot(v, of_v)},
                           .pressing = pressing,
                           .coupling = {glm::dot(n, of_u), glm::dot(n, of_v)}},
                          static_cast<Real>(collider.friction));
    position += friction.back.x * u + friction.back.y * v;
    contact.force += friction.pressing * n - friction.force.x * u - friction.force.y * v;
    // It falls to nothing where all slip is taken back.
    contact.across = friction.yielding * stiffness > Real(1) ? Real(1) / friction.yielding : stiffness;
    return true;
}

}  // namespace gelatin::cpu
