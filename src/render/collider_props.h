#pragma once

#include <optional>
#include <vector>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "render/camera.h"

namespace gelatin::render {

/// How colliders look.
struct ColliderProps {
    std::optional<float> floor_height;  ///< of the highest plane that lies flat and faces up [m]
    std::vector<SurfaceMesh> props;  ///< boxes, spheres, capsules, and a piece of each plane that is tilted
};

/// @param bounds where the bodies are: pieces of planes are taken round there
ColliderProps make_collider_props(const std::vector<ColliderDescription>& colliders, const Bounds& bounds);

}  // namespace gelatin::render
