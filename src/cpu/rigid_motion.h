#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <span>

#include "cpu/nodes.h"

namespace gelatin::cpu {

/// A motion of a body that keeps its shape: x becomes center + shift + turn (x - center).
struct RigidMotion {
    glm::dvec3 center{0.0}, shift{0.0};  ///< [m]
    glm::dmat3 turn{1.0};

    glm::dvec3 move(const glm::dvec3& x) const { return center + shift + turn * (x - center); }
};

/// The turn about w by 2 atan(|w| / 2), which is |w| to third order: Cayley's 1 + 4 / (4 + w^2) (W + W^2 / 2)
/// with W x = w x x. Less than half a turn for any w.
inline glm::dmat3 cayley_turn(const glm::dvec3& w) {
    const glm::dmat3 cross(glm::dvec3(0.0, w.z, -w.y), glm::dvec3(-w.z, 0.0, w.x),
                           glm::dvec3(w.y, -w.x, 0.0));
    return glm::dmat3(1.0) + 4.0 / (4.0 + glm::dot(w, w)) * (cross + 0.5 * cross * cross);
}

/// The motion of nodes as one rigid body that brings them nearest to `targets`, in the sense of
/// sum m |x - target|^2 to first order in the turn: the centre of mass goes to that of the targets, and the
/// turn is about w of
///   sum m (r^2 - r r^T) w = sum m r x (target - x),   r = x - center.
/// @param nodes xyz [m], inverse mass [1/kg] > 0
template <class Real>
RigidMotion nearest_rigid_motion(std::span<const Vec4<Real>> nodes, std::span<const Vec3<Real>> targets);

}  // namespace gelatin::cpu
