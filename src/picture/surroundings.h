#pragma once

#include "gelatin/simulator.h"
#include "render/renderer.h"

namespace gelatin {

/// A scene's floor, colliders and colours, for a renderer; its scale is that of the bodies' present
/// positions. The highest level plane is the floor.
render::Surroundings describe_surroundings(const Simulator& simulator);

render::Camera camera_of(const CameraDescription& description);

/// The scene's own camera, or one that shows the whole scene.
/// @param aspect width divided by height of the picture
render::Camera choose_camera(const Scene& scene, const render::Surroundings& surroundings, float aspect);

}  // namespace gelatin
