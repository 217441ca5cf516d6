#pragma once

#include <filesystem>
#include <map>

namespace gelatin::viewer {

/// Notices when somebody has saved a shader in GELATIN_SHADER_DIR.
class ShaderWatch {
public:
    ShaderWatch();

    /// True once after a file has changed, come or gone. Looks at most twice a second. @param now [s]
    bool has_changed(double now);

private:
    using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
    Times read_times() const;

    std::filesystem::path folder_;  // empty: there is nothing to watch
    Times times_;
    double next_look_ = 0.0;  // [s]
};

}  // namespace gelatin::viewer
