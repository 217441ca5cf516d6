#include "shader_watch.h"

#include <cstdlib>

namespace gelatin::viewer {
namespace {

constexpr double kInterval = 0.5;  // [s]

}  // namespace

ShaderWatch::ShaderWatch() {
    if (const char* folder = std::getenv("GELATIN_SHADER_DIR")) folder_ = folder;
    times_ = read_times();
}

bool ShaderWatch::has_changed(double now) {
    if (folder_.empty() || now < next_look_) return false;
    next_look_ = now + kInterval;
    Times times = read_times();
    if (times == times_) return false;
    times_ = std::move(times);
    return true;
}

// Editors may be replacing a file just now: what cannot be read is read next time.
ShaderWatch::Times ShaderWatch::read_times() const {
    Times times;
    if (folder_.empty()) return times;
    std::error_code none;
    for (auto entry = std::filesystem::recursive_directory_iterator(folder_, none);
         entry != std::filesystem::recursive_directory_iterator(); entry.increment(none)) {
        const auto time = entry->last_write_time(none);
        if (!none && entry->is_regular_file(none)) times[entry->path()] = time;
    }
    return times;
}

}  // namespace gelatin::viewer
