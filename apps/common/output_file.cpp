#include "common/output_file.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "core/file.h"
#include "core/file_writer.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "model/scene/names.h"

namespace gelatin {
namespace fs = std::filesystem;

void check_output_file(const std::string& option, const fs::path& file,
                       const std::vector<std::string>& endings) {
    const auto fail = [&](const std::string& problem) {
        throw InvalidInput({{}, 0, option, file.string(), problem});
    };
    if (is_stream(file)) {
        if (!is_standard_output(file) && ::access(file.c_str(), W_OK) != 0) fail("cannot be written");
        return;
    }
    if (!endings.empty()) check_ending(option, file, endings);
    std::error_code ignored;  // what cannot be asked cannot be written, and says so below
    const fs::path target = link_target(file);
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) fail("there is no folder " + folder.string());
    if (fs::is_directory(file, ignored)) fail("is a folder");
    try {
        const ScratchFile attempt(folder);
    } catch (const SystemError& error) {
        fail(error.what());
    }
}

void check_ending(const std::string& option, const fs::path& file, const std::vector<std::string>& endings) {
    if (std::find(endings.begin(), endings.end(), lower_case_ending(file)) != endings.end()) return;
    throw InvalidInput({{}, 0, option, file.string(), "must end in " + join_names(endings, "or")});
}

std::FILE* message_stream(std::initializer_list<fs::path> files) {
    return std::any_of(files.begin(), files.end(), is_standard_output) ? stderr : stdout;
}

}  // namespace gelatin
