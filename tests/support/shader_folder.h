#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "core/file.h"
#include "support/environment.h"

namespace gelatin::test {

/// A folder of shaders for one test; while it lives, GELATIN_SHADER_DIR points there.
class ShaderFolder {
public:
    void add(const std::string& name, const std::string& text) {
        const std::filesystem::path file = folder_.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }
    const std::filesystem::path& path() const { return folder_.path(); }

private:
    TemporaryFolder folder_;
    EnvironmentVariable variable_{"GELATIN_SHADER_DIR", folder_.path().string()};
};

}  // namespace gelatin::test
