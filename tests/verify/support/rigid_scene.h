#pragma once

#include <string>

#include "gelatin/scene.h"

namespace gelatin::test {

constexpr double kGravity = 9.81, kDensity = 1000.0;

/// With one material, "stuff", which does not bounce.
inline Scene rigid_scene(double friction = 0.5, const glm::dvec3& gravity = {0.0, -kGravity, 0.0}) {
    Scene scene;
    scene.simulation.solver = SolverKind::implicit;
    scene.simulation.gravity = gravity;
    scene.collision.response = CollisionResponse::contact;
    scene.materials.resize(1);
    scene.materials[0].name = "stuff";
    scene.materials[0].density = kDensity;
    scene.materials[0].friction = friction;
    scene.materials[0].restitution = 0.0;
    return scene;
}

inline void add_floor(Scene& scene, double friction = 0.5) {
    ColliderDescription floor;
    floor.shape = PlaneCollider{};
    floor.friction = friction;
    floor.restitution = 0.0;
    scene.colliders = {floor};
}

inline ObjectDescription rigid(const std::string& name, const Shape& shape, const glm::dvec3& position) {
    ObjectDescription object;
    object.name = name;
    object.shape = shape;
    object.material = "stuff";
    object.position = position;
    object.rigid.emplace();
    return object;
}

inline ObjectDescription rigid_box(const std::string& name, const glm::dvec3& size,
                                   const glm::dvec3& position) {
    return rigid(name, BoxShape{size}, position);
}

}  // namespace gelatin::test
