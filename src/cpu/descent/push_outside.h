#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cpu/collision/colliders.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

/// What Coulomb's friction makes of a slip within a plane.
template <class Real>
struct Slip {
    glm::vec<2, Real> force{0};  ///< against the slip [N]
    Real yielding = 0;           ///< what is left of the slip, by the force [m/N]; 0 where friction holds
};

/// Finds the force f = K (slip - left) of at most `most` that acts along `left`, where anything is left. So
/// (I + y K) f = K slip with the least y >= 0, and left = y f: a trust region problem, in which three of
/// Newton's steps on 1 / |f| come to rounding (More and Sorensen 1983).
/// @param stiffness K of the node within the plane: xx, xy, yy [N/m] @param slip without friction [m]
/// @param most that friction may be [N]
template <class Real>
Slip<Real> slip_with_friction(const Vec3<Real>& stiffness, const glm::vec<2, Real>& slip, Real most) {
    using Vector = glm::vec<2, Real>;
    const auto times = [](const Vec3<Real>& m, const Vector& v) {
        return Vector(m.x * v.x + m.y * v.y, m.y * v.x + m.z * v.y);
    };
    const Vector holding = times(stiffness, slip);
    Slip<Real> found{holding, Real(0)};
    Real length = glm::length(holding);
    most = std::max(most, Real(1e-6) * length);  // of less, y is lost in rounding
    for (int round = 0; round < 3 && length > most; ++round) {
        const auto inverse = [&] {
            const Vec3<Real> m = Vec3<Real>(1, 0, 1) + found.yielding * stiffness;
            return Vec3<Real>(m.z, -m.y, m.x) / (m.x * m.z - m.y * m.y);
        };
        const Real falling = glm::dot(found.force, times(inverse(), times(stiffness, found.force)));
        found.yielding += (length / most - Real(1)) * length * length / falling;
        found.force = times(inverse(), holding);
        length = glm::length(found.force);
    }
    if (length > most) found.force *= most / length;
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
    contact.force += pressing * n;
    contact.normal = n;
    contact.along = stiffness;
    contact.across = Real(0);

    const Real most = static_cast<Real>(collider.friction) * pressing;
    if (!(most > Real(0))) return true;
    const Vec3<Real> u =
        glm::normalize(glm::cross(n, std::abs(n.x) < Real(0.5) ? Vec3<Real>(1, 0, 0) : Vec3<Real>(0, 1, 0)));
    const Vec3<Real> v = glm::cross(n, u), of_u = hessian * u, of_v = hessian * v;
    const Vec3<Real> displacement = position - start;
    const glm::vec<2, Real> slip(glm::dot(u, displacement), glm::dot(v, displacement));
    const Slip<Real> left =
        slip_with_friction(Vec3<Real>(glm::dot(u, of_u), glm::dot(u, of_v), glm::dot(v, of_v)), slip, most);
    const glm::vec<2, Real> back = left.yielding * left.force - slip;
    position += back.x * u + back.y * v;
    contact.force -= left.force.x * u + left.force.y * v;
    // It falls to nothing where all slip is taken back.
    contact.across = left.yielding * stiffness > Real(1) ? Real(1) / left.yielding : stiffness;
    return true;
}

}  // namespace gelatin::cpu
