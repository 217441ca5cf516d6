#include "scene_source.h"

#include <utility>

#include "model/assembly/build_model.h"

namespace gelatin::viewer {

LoadedScene load_scene_source(const SceneInput& input) {
    const bool is_played = is_recording_input(input) && input.overrides.empty();
    if (!is_played) return build_scene(load_input(input));
    auto recording = std::make_shared<const Recording>(input.files.front());
    LoadedScene loaded = build_scene(recording->scene());
    loaded.recording = std::move(recording);
    return loaded;
}

LoadedScene build_scene(const Scene& scene) {
    return {scene, std::make_shared<const Model>(build_model(scene))};
}

}  // namespace gelatin::viewer
