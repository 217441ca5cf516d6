#pragma once

#include <vector>

#include "gelatin/drag.h"
#include "gelatin/scene.h"

namespace gelatin::viewer {

/// The scene with the present drags as drags from the start on; a pin that was dragged becomes a handle.
/// @param held from the simulation of this scene
Scene dragged_scene(Scene scene, const std::vector<HeldNodes>& held);

/// The scene without one of its pins or handles.
Scene released_scene(Scene scene, const HeldNodes& held);

}  // namespace gelatin::viewer
