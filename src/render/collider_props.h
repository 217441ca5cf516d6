#pragma once

#include <optional>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"

namespace gelatin::render {

/// The surfaces that show colliders.
struct ColliderProps {
    std::optional<float> floor_height;  ///< of the highest plane that is level and faces up [m]
    std::vector<SurfaceMesh> props;     ///< boxes, spheres, capsules, and a piece of each tilted plane
};

/// @param bounds of the bodies: pieces of planes are cut out around them
/// @param up the scene's up axis
ColliderProps make_collider_props(const std::vector<ColliderDescription>& colliders, const Bounds& bounds,
                                  Axis up = Axis::y);

}  // namespace gelatin::render
