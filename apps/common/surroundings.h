#pragma once

#include "gelatin/simulator.h"
#include "render/renderer.h"

namespace gelatin {

/// A scene's floor, colliders and colours, for a renderer; its scale is that of the bodies as they lie now.
/// The highest level plane is the floor.
render::Surroundings describe_surroundings(const Simulator& simulator);

/// The scene's own camera, or one that shows all of it.
/// @param aspect width over height of the picture
render::Camera choose_camera(const Scene& scene, const render::Surroundings& surroundings, float aspect);

}  // namespace gelatin
