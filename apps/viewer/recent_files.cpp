#include "recent_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "core/file.h"
#include "core/log.h"
#include "gelatin/error.h"

namespace gelatin::viewer {
namespace {

namespace fs = std::filesystem;

fs::path from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? fs::path() : fs::path(value);
}

// Nothing if it is no list of absolute paths.
std::optional<RecentFiles::Files> parse(const std::string& line) {
    constexpr std::size_t kLongest = 16384;
    if (line.empty() || line.size() > kLongest) return {};
    RecentFiles::Files files;
    std::istringstream names(line);
    for (std::string name; std::getline(names, name, '\t');) {
        const bool has_control =
            std::any_of(name.begin(), name.end(), [](char c) { return c >= 0 && c < 32; });
        const fs::path file(name);
        if (has_control || !file.is_absolute() || !file.has_filename()) return {};
        files.push_back(file);
    }
    return files;
}

std::string format(const RecentFiles::Files& files) {
    std::string line;
    for (const fs::path& file : files) line += (line.empty() ? "" : "\t") + file.string();
    return line;
}

}  // namespace

fs::path RecentFiles::default_file() {
    if (const fs::path state = from_environment("XDG_STATE_HOME"); state.is_absolute())
        return state / "gelatin" / "recent";
    if (const fs::path home = from_environment("HOME"); !home.empty())
        return home / ".local" / "state" / "gelatin" / "recent";
    return {};
}

RecentFiles::RecentFiles(fs::path file) : file_(std::move(file)) {
    constexpr std::uintmax_t kLargest = 1 << 20;  // [bytes]
    std::error_code error;
    if (!fs::is_regular_file(file_, error) || fs::file_size(file_, error) > kLargest || error) return;
    try {
        std::istringstream lines(read_file(file_));
        for (std::string line; all_.size() < kMost && std::getline(lines, line);) {
            if (auto files = parse(line)) all_.push_back(std::move(*files));
        }
    } catch (const InvalidInput& problem) {
        log_warning(fmt::format("the files opened last are not known: {}", problem.what()));
    }
}

void RecentFiles::add(const Files& files) {
    Files absolute;
    std::error_code error;
    for (const fs::path& file : files) {
        if (!fs::is_regular_file(file, error)) return;
        absolute.push_back(fs::absolute(file).lexically_normal());
    }
    if (parse(format(absolute)) != absolute) return;
    if (!all_.empty() && all_.front() == absolute) return;
    std::erase(all_, absolute);
    all_.insert(all_.begin(), std::move(absolute));
    if (all_.size() > kMost) all_.resize(kMost);
    if (file_.empty()) return;
    std::string text;
    for (const Files& each : all_) text += format(each) + "\n";
    try {
        fs::create_directories(file_.parent_path());
        write_file(file_, text);
    } catch (const fs::filesystem_error& problem) {
        log_warning(fmt::format("the files opened last cannot be remembered: {}", problem.what()));
    } catch (const SystemError& problem) {
        log_warning(fmt::format("the files opened last cannot be remembered: {}", problem.what()));
    }
}

}  // namespace gelatin::viewer
