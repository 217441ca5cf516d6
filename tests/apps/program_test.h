#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/file.h"
#include "support/run_program.h"

namespace gelatin::test {

/// Runs the real program in a folder of its own, which has a small scene: a cube that falls on a floor.
class ProgramTest : public testing::Test {
protected:
    ProgramTest() {
        write("cube.toml",
              "[simulation]\n"
              "solver = 'semi_implicit_euler'\n"
              "frame_rate = 100\n"
              "frames = 20\n"
              "[[material]]\n"
              "name = 'jelly'\n"
              "[[object]]\n"
              "name = 'cube'\n"
              "shape = { box = [1, 1, 1], segments = [3, 3, 3] }\n"
              "position = [0, 5, 0]\n"
              "[[collider]]\n"
              "shape = { plane = [0, 1, 0] }\n");
        settings_.folder = folder_.path();
        settings_.environment = {"GELATIN_CACHE_DIR=" + path("cache").string(),
                                 "XDG_STATE_HOME=" + path("state").string()};
    }

    std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    void write(const std::string& name, const std::string& text) const { write_file(path(name), text); }
    bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
    nlohmann::json read_json(const std::string& name) const {
        return nlohmann::json::parse(read_file(path(name)));
    }

    ProgramResult run(const std::vector<std::string>& arguments) const {
        return run_gelatin(arguments, settings_);
    }

    /// The program must refuse the call in one line.
    void expect_error(const std::vector<std::string>& arguments, int exit_code,
                      const std::string& message) const {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, exit_code);
        EXPECT_EQ(result.err, "gelatin: error: " + message + "\n");
        EXPECT_EQ(result.out, "");
    }

    /// Files of the folder that are half-written.
    std::vector<std::string> partial_files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            if (name.find(".partial") != std::string::npos) names.push_back(name);
        }
        return names;
    }

    ProgramSettings settings_;

private:
    TemporaryFolder folder_;
};

/// The same for what needs OpenGL: skipped where there is none, unless GELATIN_REQUIRE_GL=1.
class DrawingProgramTest : public ProgramTest {
protected:
    void SetUp() override {
        const char* required = std::getenv("GELATIN_REQUIRE_GL");
        if (required != nullptr && std::string(required) == "1") return;
        const ProgramResult info = run({"info", "--json"});
        if (nlohmann::json::parse(info.out)["opengl"]["default"].contains("unusable")) {
            GTEST_SKIP() << "no OpenGL 4.3";
        }
    }
};

}  // namespace gelatin::test
