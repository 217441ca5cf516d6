#pragma once

#include <filesystem>
#include <map>

namespace gelatin::viewer {

/// Notices when a shader in GELATIN_SHADER_DIR is saved.
class ShaderWatch {
public:
    ShaderWatch();

    /// True once after a file has changed, appeared or disappeared. Checks at most twice a second. @param now
    /// [s]
    bool has_changed(double now);

private:
    using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Times read_times() const;

    std::filesystem::path folder_;  // empty: nothing is watched
    Times times_;
    double next_look_ = 0.0;  // [s]
};

}  // namespace gelatin::viewer
