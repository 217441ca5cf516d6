#include "cpu/collision/colliders.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

namespace gelatin::cpu {

namespace {

template <class Real>
SurfaceDistance<Real> distance_from_center(const Vec3<Real>& from_center, Real radius) {
    const Real length = glm::length(from_center);
    return {length - radius, length > Real(0) ? from_center / length : Vec3<Real>(0, 1, 0)};
}

template <class Real>
SurfaceDistance<Real> distance_to_box(const Vec3<Real>& p, const Vec3<Real>& half_extents) {
    const Vec3<Real> q = glm::abs(p) - half_extents;
    const Vec3<Real> side(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1, p.z < 0 ? -1 : 1);
    const Vec3<Real> outside = glm::max(q, Vec3<Real>(0));
    const Real length = glm::length(outside);
    if (length > Real(0)) return {length, side * outside / length};
    // Inside: outwards through the nearest side.
    if (q.x >= q.y && q.x >= q.z) return {q.x, Vec3<Real>(side.x, 0, 0)};
    if (q.y >= q.z) return {q.y, Vec3<Real>(0, side.y, 0)};
    return {q.z, Vec3<Real>(0, 0, side.z)};
}

}  // namespace

template <class Real>
SurfaceDistance<Real> distance_to_solid(const Collider& collider, const Vec3<Real>& p) {
    const Vec3<Real> center(collider.center);
    const auto radius = static_cast<Real>(collider.center.w);
    if (collider.kind == 2) return distance_from_center(p - center, radius);
    const Vec3<Real> axis(collider.axis);
    if (collider.kind == 3) {
        const Real along = glm::clamp(glm::dot(p - center, axis) / glm::dot(axis, axis), Real(-1), Real(1));
        return distance_from_center(p - center - along * axis, radius);
    }
    const glm::qua<Real> q(
        static_cast<Real>(collider.orientation.w), static_cast<Real>(collider.orientation.x),
        static_cast<Real>(collider.orientation.y), static_cast<Real>(collider.orientation.z));
    const SurfaceDistance<Real> local = distance_to_box(glm::inverse(q) * (p - center), axis);
    return {local.distance, q * local.normal};
}

template SurfaceDistance<float> distance_to_solid(const Collider&, const Vec3<float>&);
template SurfaceDistance<double> distance_to_solid(const Collider&, const Vec3<double>&);

}  // namespace gelatin::cpu
