#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "model/assembly/object_mesh.h"
#include "model/drive/handle_animation.h"
#include "model/model.h"

namespace gelatin {

/// A collider of CollisionResponse::contact, ready to be packed.
struct ColliderSurface {
    std::string name;
    SurfaceMesh mesh;  ///< where the collider starts
    ColliderDescription description;
    /// How its vertices move by themselves; empty: they do not. Arms are from the origin of the scene.
    std::optional<HandleAnimation> animation = {};
};

/// A collider whose shape is upright by its rotation alone, in any scene.
ColliderDescription upright(ColliderDescription collider, Axis scene_up);

/// Upright, a scene's colliders that have no surface: all of them, but with CollisionResponse::contact planes
/// alone.
std::vector<ColliderDescription> solid_colliders(const Scene& scene);

/// Of the scene's other colliders. Repairs go to the log, one line each.
/// @throws InvalidInput for files that cannot be read, and surfaces without faces
std::vector<ColliderSurface> make_collider_surfaces(const Scene& scene, ObjectMesher& mesher);
std::vector<ColliderSurface> make_collider_surfaces(const Scene& scene);

/// Appends a surface: nodes that are held, by a handle if it moves. Its faces turn their fronts to bodies
/// that start within it, so that it is drawn from inside. @pre all bodies are there
void append_surface(const ColliderSurface& surface, Model& model);

/// The name of a scene's collider.
std::string name_of_collider(const ColliderDescription& collider, std::size_t index);

}  // namespace gelatin
