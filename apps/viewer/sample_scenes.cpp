#include "sample_scenes.h"

#include <algorithm>
#include <sstream>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin::viewer {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& scene) {
    try {
        return first_sentence(read_file(scene));
    } catch (const InvalidInput&) {
        return {};  // whoever chooses it sees the error
    }
}

}  // namespace

std::vector<SampleScene> sample_scenes() {
    fs::path folder = "scenes";
    if (!fs::is_directory(folder)) folder = GELATIN_SCENES;
    std::vector<SampleScene> scenes;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const fs::path& file = entry.path();
        if (file.extension() != ".toml") continue;
        scenes.push_back({file, line_of(file), folder / "pictures" / (file.stem().string() + ".png")});
    }
    std::sort(scenes.begin(), scenes.end(),
              [](const SampleScene& a, const SampleScene& b) { return a.file < b.file; });
    return scenes;
}

std::string first_sentence(std::string_view scene) {
    std::istringstream lines{std::string(scene)};
    std::string comment;
    for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        const std::size_t begin = line.find_first_not_of("# ");
        if (begin == std::string::npos) break;
        comment += (comment.empty() ? "" : " ") + line.substr(begin);
    }
    const std::size_t end = comment.find(". ");
    return end == std::string::npos ? comment : comment.substr(0, end + 1);
}

}  // namespace gelatin::viewer
