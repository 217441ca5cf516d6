#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "scene_source.h"
#include "worker.h"

namespace gelatin::viewer {

/// Opens and rebuilds scenes while the window goes on: one at a time, and of those asked for meanwhile the
/// last.
class SceneLoader {
public:
    /// What to do with a scene when it comes.
    enum class Purpose {
        show,   ///< from its start
        go_on,  ///< from where the scene is that was edited
    };
    struct Result {
        LoadedScene loaded;
        Purpose purpose;
        std::filesystem::path file;
    };

    void open(const std::filesystem::path& file, const std::vector<std::string>& overrides);
    /// Builds a scene that was edited.
    void rebuild(const Scene& scene);

    bool is_busy() const { return current_.work != nullptr; }
    /// What is being opened.
    const std::filesystem::path& file() const { return current_.file; }
    Purpose purpose() const { return current_.purpose; }

    /// What has come since the last call, if anything. @throws what went wrong with it
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
    LoadedScene loaded_;  // the worker's, while it is busy
    Worker worker_;
};

}  // namespace gelatin::viewer
