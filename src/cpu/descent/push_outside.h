#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/collision/colliders.h"
#include "cpu/descent/collider_contacts.h"
#include "cpu/elasticity/elements.h"

namespace gelatin::cpu {

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

    const Vec3<Real> displacement = position - start;
    const Vec3<Real> slid = displacement - glm::dot(displacement, n) * n;
    const Real length = glm::length(slid);
    if (length == Real(0)) return true;
    const Vec3<Real> t = slid / length;
    Vec3<Real> giving = solve(hessian, t);
    giving -= stiffness * glm::dot(n, giving) * yielding;  // within the plane
    const Real sliding_compliance = glm::dot(t, giving);
    if (!(sliding_compliance > Real(0))) return true;
    const Real needed = length / sliding_compliance;
    const Real most = static_cast<Real>(collider.friction) * pressing;
    position -= std::min(needed, most) * giving;
    contact.force -= std::min(needed, most) * t;
    // It falls to nothing where all sliding is taken back.
    const Real left = length - std::min(needed, most) * sliding_compliance;
    contact.across = most < stiffness * left ? most / left : stiffness;
    return true;
}

}  // namespace gelatin::cpu
