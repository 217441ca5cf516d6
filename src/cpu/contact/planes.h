#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "cpu/collision/colliders.h"
#include "cpu/contact/contact_list.h"
#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// What keeps moves of bodies outside the planes among the colliders. A plane is the boundary of a convex
/// set: between two positions outside it all are.

/// The nearest position outside all planes [m].
template <class Real>
Vec3<Real> outside_planes(std::span<const Collider> colliders, Vec3<Real> position) {
    for (const Collider& collider : colliders) {
        if (collider.kind != 0) continue;
        const SurfaceDistance<Real> surface = surface_distance(collider, position);
        if (surface.distance < Real(0)) position -= surface.distance * surface.normal;
    }
    return position;
}

/// The part of a motion that takes a node no deeper into any plane than it is, or to the surface.
template <class Real>
Real part_outside_planes(std::span<const Collider> colliders, const Vec3<Real>& position,
                         const Vec3<Real>& motion) {
    Real part = 1;
    for (const Collider& collider : colliders) {
        if (collider.kind != 0) continue;
        const SurfaceDistance<Real> surface = surface_distance(collider, position);
        const Real approach = -glm::dot(surface.normal, motion);
        if (!(approach > Real(0))) continue;
        part = std::min(part, std::max(surface.distance, Real(0)) / approach);
    }
    return part;
}

/// The least of any along a direction [m].
template <class Real>
Real least_height(std::span<const Vec4<Real>> positions, const Vec3<Real>& direction) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Vec4<Real>& position : positions)
        least = std::min(least, glm::dot(direction, Vec3<Real>(position)));
    return least;
}

/// Shortens the motions of islands, with all of their bodies' nodes, so.
/// @param motions by island [m]
template <class Real>
void keep_outside_planes(const Model& model, const ContactList<Real>& list,
                         std::span<const Vec4<Real>> positions, std::vector<Vec3<Real>>& motions) {
    if (model.colliders.empty()) return;
    std::vector<Real> parts(motions.size(), Real(1));
    for (std::size_t o = 0; o < model.body_count(); ++o) {
        const std::uint32_t i = list.islands[o];
        for (const Collider& collider : model.colliders) {
            const Vec3<Real> normal(collider.center);
            const Real approach = -glm::dot(normal, motions[i]);
            if (collider.kind != 0 || !(approach > Real(0))) continue;
            const Range& nodes = model.objects[o].nodes;
            const Real least = least_height(positions.subspan(nodes.first, nodes.count), normal) -
                               static_cast<Real>(collider.center.w);
            parts[i] = std::min(parts[i], std::max(least, Real(0)) / approach);
        }
    }
    for (std::size_t i = 0; i < motions.size(); ++i) motions[i] *= parts[i];
}

}  // namespace gelatin::cpu
