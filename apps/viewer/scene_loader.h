#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "scene_source.h"
#include "worker.h"

namespace gelatin::viewer {

/// Opens and rebuilds scenes in the background, one at a time. Of several requests in the meantime the last
/// counts.
class SceneLoader {
public:
    /// How a loaded scene starts.
    enum class Purpose {
        show,   ///< from its start
        go_on,  ///< from the state of the scene that was edited
    };
    struct Result {
        LoadedScene loaded;
        Purpose purpose;
        std::filesystem::path file;
    };

    /// @pre there is a file
    void open(const SceneInput& input);
    /// Builds a scene that was edited.
    void rebuild(const Scene& scene);

    bool is_busy() const { return current_.work != nullptr; }
    /// What is being opened.
    const std::filesystem::path& file() const { return current_.file; }
    Purpose purpose() const { return current_.purpose; }

    /// What has been loaded since the last call, if anything. @throws its error
    std::optional<Result> take();

private:
    struct Job {
        std::filesystem::path file;
        Purpose purpose = Purpose::show;
        std::function<LoadedScene()> work;  // empty: none
    };
    void ask_for(Job job);
    void start(Job job);

    Job current_;
    std::optional<Job> next_;
    LoadedScene loaded_;  // used by the worker while it is busy
    Worker worker_;
};

}  // namespace gelatin::viewer
