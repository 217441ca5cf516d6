#pragma once

#include <string>

#include "gelatin/scene.h"
#include "verify/support/measured_run.h"
#include "verify/support/rigid_scene.h"

namespace gelatin::test {

inline Material jelly(double youngs_modulus, double damping = 0.0) {
    Material material;
    material.name = "jelly";
    material.youngs_modulus = youngs_modulus;
    material.density = kDensity;
    material.damping = damping;
    return material;
}

inline Scene scene_of(const Material& material, double gravity = kGravity) {
    Scene scene;
    scene.simulation.solver = SolverKind::implicit;
    scene.simulation.gravity = glm::dvec3(0.0, -gravity, 0.0);
    scene.materials = {material};
    scene.collision.self_collision = false;
    return scene;
}

inline ObjectDescription box(const std::string& name, const glm::dvec3& size, const glm::dvec3& position,
                             int nodes = 150) {
    ObjectDescription object;
    object.name = name;
    object.shape = BoxShape{size};
    object.mesher.kind = MesherKind::lattice;
    object.mesher.nodes = nodes;
    object.material = "jelly";
    object.position = position;
    return object;
}

inline Region above(double y) {
    return HalfSpaceRegion{{0.0, -1.0, 0.0}, -y};
}

// Three boxes in a row, each glued to the one above, the first to its place in space.
inline Scene hanging_row(double youngs_modulus = 1e5) {
    Scene scene = scene_of(jelly(youngs_modulus, 0.2));
    scene.objects = {box("top", {0.2, 0.2, 0.2}, {0.0, 1.0, 0.0}),
                     box("middle", {0.2, 0.2, 0.2}, {0.0, 0.79, 0.0}),
                     box("bottom", {0.2, 0.2, 0.2}, {0.0, 0.58, 0.0})};
    scene.attachments = {{.object = "top", .where = above(1.09)},
                         {.object = "middle", .to = "top"},
                         {.object = "bottom", .to = "middle"}};
    return scene;
}

}  // namespace gelatin::test
