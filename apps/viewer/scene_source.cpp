#include "scene_source.h"

#include "model/build/build_model.h"

namespace gelatin::viewer {

LoadedScene build_scene(const Scene& scene) {
    return {scene, std::make_shared<const Model>(build_model(scene))};
}

}  // namespace gelatin::viewer
