#pragma once

#include <memory>

#include "common/scene_input.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::viewer {

/// A scene and its model: ready to be simulated.
struct LoadedScene {
    Scene scene;
    std::shared_ptr<const Model> model;
};

/// Builds a scene's model; without OpenGL, so on any thread. @throws InvalidInput
LoadedScene build_scene(const Scene& scene);

}  // namespace gelatin::viewer
