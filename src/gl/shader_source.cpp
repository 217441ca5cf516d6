#include "gl/shader_source.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string_view>

#include "gelatin/error.h"
#include "gl/embedded_shaders.h"

namespace gelatin::gl {
namespace {

std::map<std::string, std::string>& overrides() {
    static std::map<std::string, std::string> texts;  // by file
    return texts;
}

std::optional<std::string> read_shader(const std::string& file) {
    if (const auto found = overrides().find(file); found != overrides().end()) return found->second;
    if (const char* folder = std::getenv("GELATIN_SHADER_DIR"); folder != nullptr && *folder != '\0') {
        std::ifstream stream(std::string(folder) + "/" + file, std::ios::binary);
        if (!stream) return {};
        return std::string(std::istreambuf_iterator<char>(stream), {});
    }
    const auto& all = embedded_shaders();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const EmbeddedShader& shader) { return shader.name == file; });
    if (found == all.end()) return {};
    return std::string(found->text);
}

std::string where_shaders_are() {
    const char* folder = std::getenv("GELATIN_SHADER_DIR");
    if (folder == nullptr || *folder == '\0') return "the program's own shaders";
    return std::string("GELATIN_SHADER_DIR = ") + folder;
}

std::string text_of(const std::string& file, const std::string& included_from) {
    std::optional<std::string> text = read_shader(file);
    if (!text) throw GlError(included_from + "no shader " + file + " in " + where_shaders_are());
    return *std::move(text);
}

// The path of `#include "path"`; empty for any other line.
std::string included_path(const std::string& line) {
    static const std::regex pattern(R"(^\s*#\s*include\s*"([^"]+)\"\s*(//.*)?\r?$)");
    std::smatch match;
    // Nearly all lines are none: the expression is for the few that start right.
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] != '#') return {};
    return std::regex_match(line, match, pattern) ? match[1].str() : std::string();
}

class Expander {
public:
    ShaderSource source;

    void expand(const std::string& file, const std::string& included_from) {
        const std::string text = text_of(file, included_from);
        const std::size_t number = source.files.size();
        source.files.push_back(file);
        open_.push_back(file);
        append_line_directive(1, number);

        std::istringstream lines(text);
        int line_number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++line_number;
            const std::string path = included_path(line);
            if (path.empty()) {
                source.text += line + "\n";
            } else if (include(path, file + ":" + std::to_string(line_number) + ": ")) {
                append_line_directive(line_number + 1, number);
            } else {
                source.text += "\n";
            }
        }
        open_.pop_back();
    }

private:
    // False if it is there already.
    bool include(const std::string& path, const std::string& place) {
        if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
            throw GlError(place + "#include of " + path + " goes round in a circle");
        }
        if (std::find(source.files.begin(), source.files.end(), path) != source.files.end()) return false;
        expand(path, place);
        return true;
    }

    void append_line_directive(int line, std::size_t number) {
        source.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
    }

    std::vector<std::string> open_;  // the files being expanded, outermost first
};

}  // namespace

std::string ShaderSource::translate_log(const std::string& log) const {
    static const std::regex position(R"(^((?:ERROR: |WARNING: )?)(\d+)(?::(\d+)|\((\d+)\)))");
    std::istringstream lines(log);
    std::string translated;
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_search(line, match, position) && match[2].length() < 9 &&
            std::stoul(match[2]) < files.size()) {
            const std::string line_number = match[3].matched ? match[3] : match[4];
            line = match[1].str() + files[std::stoul(match[2])] + ":" + line_number + match.suffix().str();
        }
        translated += line + "\n";
    }
    return translated;
}

std::string shader_text(const std::string& file) {
    return text_of(file, "");
}

void dump_shader(const std::string& file, const ShaderSource& source) {
    const char* folder = std::getenv("GELATIN_DUMP_SHADERS");
    if (folder == nullptr || *folder == '\0') return;
    std::string stem = file.substr(0, file.rfind('.'));
    std::replace(stem.begin(), stem.end(), '/', '_');
    std::ostringstream path;
    path << folder << '/' << stem << '-' << std::hex << std::hash<std::string>()(source.text)
         << file.substr(file.rfind('.'));
    if (std::ofstream stream(path.str(), std::ios::binary); !(stream << source.text).flush())
        throw GlError("cannot write " + path.str() + " (GELATIN_DUMP_SHADERS)");
}

ShaderSource load_shader(const std::string& file, const std::vector<std::string>& defines) {
    Expander expander;
    expander.source.text = "#version 430 core\n";
    for (const std::string& define : defines) expander.source.text += "#define " + define + "\n";
    expander.expand(file, "");
    return std::move(expander.source);
}

ShaderOverride::ShaderOverride(std::string file, std::string text) : file_(std::move(file)) {
    [[maybe_unused]] const bool is_new = overrides().emplace(file_, std::move(text)).second;
    assert(is_new);
}

ShaderOverride::~ShaderOverride() {
    overrides().erase(file_);
}

}  // namespace gelatin::gl
