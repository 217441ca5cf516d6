#pragma once

#include "gelatin/simulator.h"
#include "picture/shown.h"
#include "render/renderer.h"

namespace gelatin {

/// A scene's floor, colliders and colours, for a renderer; its scale is that of the bodies that are shown.
/// The highest level plane is the floor.
render::Surroundings describe_surroundings(const Simulator& simulator, const Shown& shown);

render::Camera camera_of(const CameraDescription& description);

}  // namespace gelatin
