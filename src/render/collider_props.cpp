#include "render/collider_props.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <variant>

#include "mesh/shapes.h"

namespace gelatin::render {
namespace {

constexpr double kFlat = 0.9999;  // smallest upward part of the normal of a plane that is drawn as the floor

SurfaceMesh placed(SurfaceMesh mesh, const ColliderDescription& collider) {
    const glm::dvec3 angles = glm::radians(collider.rotation);
    glm::dmat4 transform = glm::translate(glm::dmat4(1.0), collider.position);
    transform = glm::rotate(transform, angles.z, {0.0, 0.0, 1.0});
    transform = glm::rotate(transform, angles.y, {0.0, 1.0, 0.0});
    transform = glm::rotate(transform, angles.x, {1.0, 0.0, 0.0});
    for (glm::dvec3& p : mesh.positions) p = glm::dvec3(transform * glm::dvec4(p, 1.0));
    return mesh;
}

// A square of the plane near the bodies. Seen from behind it is not drawn, and hides nothing.
SurfaceMesh piece_of(const PlaneCollider& plane, const Bounds& bounds, const glm::dvec3& up) {
    const glm::dvec3 n = plane.normal;
    const glm::dvec3 middle(bounds.center());
    const glm::dvec3 center = middle - (glm::dot(n, middle) - plane.offset) * n;
    const glm::dvec3 any = std::abs(glm::dot(n, up)) < 0.9 ? up : glm::dvec3(1.0, 0.0, 0.0);
    const double half = std::max(1.0 * glm::length(glm::dvec3(bounds.size())), 1e-3);
    const glm::dvec3 u = half * glm::normalize(glm::cross(any, n));
    const glm::dvec3 v = glm::cross(n, u);
    return {{center - u - v, center + u - v, center + u + v, center - u + v}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

ColliderProps make_collider_props(const std::vector<ColliderDescription>& colliders, const Bounds& bounds,
                                  Axis up) {
    const glm::dvec3 upwards = up == Axis::z ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    ColliderProps all;
    for (const ColliderDescription& collider : colliders) {
        const auto* shape = std::get_if<Shape>(&collider.shape);
        if (const auto* plane = std::get_if<PlaneCollider>(&collider.shape)) {
            const double upward = glm::dot(plane->normal, upwards);
            if (upward >= kFlat) {
                const auto height = static_cast<float>(plane->offset / upward);
                all.floor_height = std::max(all.floor_height.value_or(height), height);
            } else if (upward > -kFlat) {
                all.props.push_back(piece_of(*plane, bounds, upwards));
            }
        } else if (const auto* box = std::get_if<BoxShape>(shape)) {
            all.props.push_back(placed(make_box({box->size, glm::ivec3(1)}), collider));
        } else if (const auto* sphere = std::get_if<SphereShape>(shape)) {
            all.props.push_back(placed(make_sphere({sphere->radius, 16}), collider));
        } else if (const auto* capsule = std::get_if<CapsuleShape>(shape)) {
            all.props.push_back(placed(make_capsule({capsule->radius, capsule->length, 16}), collider));
        }
    }
    return all;
}

}  // namespace gelatin::render
