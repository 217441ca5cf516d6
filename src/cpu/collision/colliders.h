#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>

#include "cpu/nodes.h"
#include "model/layouts.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// How far a point is outside a collider (negative inside) [m], and the direction outwards (unit).
template <class Real>
struct SurfaceDistance {
    Real distance;
    Vec3<Real> normal;
};

/// Of a collider that is no plane. Defined in colliders.cpp, so that callers hold only the call.
template <class Real>
SurfaceDistance<Real> distance_to_solid(const Collider& collider, const Vec3<Real>& p);

/// Planes come first, since most nodes are compared to one in each step; and both results are values of their
/// own until the end, since g++ passes a struct that two branches fill through memory, at half the speed.
template <class Real>
SurfaceDistance<Real> surface_distance(const Collider& collider, const Vec3<Real>& p) {
    Vec3<Real> normal(collider.center);
    Real distance = glm::dot(normal, p) - static_cast<Real>(collider.center.w);
    if (collider.kind != 0) {
        const SurfaceDistance<Real> solid = distance_to_solid(collider, p);
        distance = solid.distance;
        normal = solid.normal;
    }
    return {distance, normal};
}

/// The velocity after a node at `velocity` has hit a surface. The normal part is reversed and scaled by the
/// restitution. The tangential part is reduced by at most friction times the normal change (Coulomb). Below
/// `resting_speed` [m/s], which gravity alone adds in a step or two, a node does not bounce.
template <class Real>
Vec3<Real> bounce(const Vec3<Real>& velocity, const Vec3<Real>& normal, Real friction, Real restitution,
                  Real resting_speed) {
    const Real approach = -glm::dot(velocity, normal);
    if (approach <= Real(0)) return velocity;
    const Real rebound = approach > resting_speed ? restitution * approach : Real(0);
    const Vec3<Real> tangential = velocity + approach * normal;
    const Real speed = glm::length(tangential);
    const Real slowing = friction * (approach + rebound);
    const Real kept = speed > slowing ? Real(1) - slowing / speed : Real(0);
    return kept * tangential + rebound * normal;
}

/// Moves a node that is inside a collider to its surface and lets it bounce; the fourth components do not
/// change. GLSL twin: sim/collision/colliders.glsl.
template <class Real>
void resolve_colliders(std::span<const Collider> colliders, Real resting_speed, Vec4<Real>& position,
                       Vec4<Real>& velocity) {
    for (const Collider& collider : colliders) {
        const SurfaceDistance<Real> surface = surface_distance(collider, Vec3<Real>(position));
        if (surface.distance >= Real(0)) continue;
        position -= Vec4<Real>(surface.distance * surface.normal, 0);
        velocity =
            Vec4<Real>(bounce(Vec3<Real>(velocity), surface.normal, static_cast<Real>(collider.friction),
                              static_cast<Real>(collider.restitution), resting_speed),
                       velocity.w);
    }
}

}  // namespace gelatin::cpu
