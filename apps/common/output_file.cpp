#include "common/output_file.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "model/scene/scene_file_reader.h"

namespace gelatin {
namespace fs = std::filesystem;

void check_output_file(const std::string& option, const fs::path& file,
                       const std::vector<std::string>& endings) {
    const auto fail = [&](const std::string& problem) {
        throw InvalidInput({{}, 0, option, file.string(), problem});
    };
    if (!endings.empty() &&
        std::find(endings.begin(), endings.end(), lower_case_ending(file)) == endings.end()) {
        fail("must end in " + join_names(endings, "or"));
    }
    std::error_code ignored;  // what cannot be asked cannot be written, and says so below
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) fail("there is no folder " + folder.string());
    if (fs::is_directory(file, ignored)) fail("is a folder");
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail("cannot be written into " + folder.string());
}

}  // namespace gelatin
