#include "scene_loader.h"

#include <utility>

namespace gelatin::viewer {

void SceneLoader::open(const SceneInput& input) {
    ask_for({input.files.front(), Purpose::show, [input] { return load_scene_source(input); }});
}

void SceneLoader::rebuild(const Scene& scene) {
    ask_for({scene.file, Purpose::go_on, [=] { return build_scene(scene); }});
}

void SceneLoader::ask_for(Job job) {
    // An edit is discarded when another scene is requested.
    const bool another =
        next_ ? next_->purpose == Purpose::show : current_.work && current_.purpose == Purpose::show;
    if (job.purpose == Purpose::go_on && another) return;
    if (current_.work) {
        next_ = std::move(job);
    } else {
        start(std::move(job));
    }
}

void SceneLoader::start(Job job) {
    current_ = std::move(job);
    worker_.start([this] { loaded_ = current_.work(); });
}

std::optional<SceneLoader::Result> SceneLoader::take() {
    if (!current_.work || worker_.is_busy()) return {};
    const Job done = std::exchange(current_, {});
    LoadedScene loaded = std::exchange(loaded_, {});
    const bool is_outdated = next_.has_value();
    if (next_) start(std::exchange(next_, {}).value());
    if (is_outdated) {
        // Nobody waits for it any more, nor for its errors.
        return {};
    }
    worker_.rethrow();
    return Result{std::move(loaded), done.purpose, done.file};
}

}  // namespace gelatin::viewer
