#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "gelatin/scene.h"

namespace gelatin::test {

using Overrides = std::vector<std::string>;

// Three lines that make a whole scene, so that a test's own text starts on line 4.
inline constexpr const char* kBall =
    "material = [{name = 'jelly'}]\n"
    "object = [{name = 'ball', shape = {sphere = 0.5}}]\n"
    "\n";

/// Reads scenes from text.
class SceneFile : public testing::Test {
protected:
    Scene load(const std::string& text, const Overrides& overrides = {}) {
        std::ofstream(file_, std::ios::binary) << text;
        return load_scene(file_, overrides);
    }

    // The whole message, the folder left out.
    std::string error(const std::string& text, const Overrides& overrides = {}) {
        try {
            load(text, overrides);
        } catch (const InvalidInput& problem) {
            std::string message = problem.what();
            const std::string folder = file_.parent_path().string() + "/";
            if (const auto at = message.find(folder); at != message.npos) message.erase(at, folder.size());
            return message;
        }
        return "no error";
    }

    // A scene whose only object is the given lines after `[[object]]` and its name (lines 3 and on).
    std::string object_error(const std::string& lines) {
        return error("material = [{name = 'jelly'}]\n[[object]]\nname = 'ball'\n" + lines + "\n");
    }

    std::string material_error(const std::string& lines) {
        return error("[[object]]\nname = 'ball'\nshape = {sphere = 1}\n[[material]]\nname = 'jelly'\n" +
                     lines + "\n");
    }

private:
    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "scene.toml";
};

}  // namespace gelatin::test
