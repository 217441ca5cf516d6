#pragma once

#include <memory>

#include "common/scene_input.h"
#include "gelatin/recording.h"
#include "gelatin/scene.h"
#include "model/model.h"

namespace gelatin::viewer {

/// A scene and its model: ready to be simulated, or played.
struct LoadedScene {
    Scene scene;
    std::shared_ptr<const Model> model;
    std::shared_ptr<const Recording> recording = {};  ///< of it, to be played
};

/// Reads a scene, meshes or a recording, and builds the model. A recording whose scene is changed by
/// overrides is not played. @throws InvalidInput
LoadedScene load_scene_source(const SceneInput& input);

/// Builds a scene's model; without OpenGL, so on any thread. @throws InvalidInput
LoadedScene build_scene(const Scene& scene);

}  // namespace gelatin::viewer
