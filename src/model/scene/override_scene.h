#pragma once

#include <string>
#include <vector>

#include "gelatin/scene.h"

namespace gelatin {

/// A scene with some values changed, as if it had been read from a file.
/// @param overrides as load_scene's
/// @throws InvalidInput as load_scene does, and for a scene that is not valid
Scene override_scene(const Scene& scene, const std::vector<std::string>& overrides);

}  // namespace gelatin
