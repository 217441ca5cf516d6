// Every shader, with every set of defines that the program has for it, is GLSL 4.30 core to a compiler that
// is not the driver's: Khronos' own, glslang. Drivers allow more than the language does, each something else.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/file.h"
#include "gpu/support/short_runs.h"
#include "support/environment.h"
#include "support/gl_fixture.h"
#include "support/run_program.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> kStages = {".comp", ".vert", ".geom", ".frag"};

// "sim_view_mark_faces.comp" for sim/view/mark_faces.comp; benchmarks have shaders of their own.
std::set<std::string> shaders_of_the_sources() {
    const fs::path root = test::source_path("shaders");
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        std::string name = fs::relative(entry.path(), root).string();
        for (char& c : name) c = c == '/' ? '_' : c;
        if (kStages.contains(entry.path().extension()) && !name.starts_with("bench_")) names.insert(name);
    }
    return names;
}

class StrictShadersHeavy : public test::GlTest {};

TEST_F(StrictShadersHeavy, AreGlslToGlslang) {
    const TemporaryFolder folder;
    {
        const test::EnvironmentVariable dump("GELATIN_DUMP_SHADERS", folder.path().string());
        for (const test::ShortRun& run : test::short_runs()) test::play(run);
    }
    std::set<std::string> missing = shaders_of_the_sources();
    std::vector<std::string> command = {"glslangValidator"};
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        const std::string stem = entry.path().stem().string();
        missing.erase(stem.substr(0, stem.rfind('-')) + entry.path().extension().string());
        command.push_back(entry.path().string());
    }
    for (const std::string& name : missing) ADD_FAILURE() << name << " is compiled by no run";
    const test::ProgramResult result = test::run_program(command);
    ASSERT_NE(result.exit_code, 127) << "glslangValidator is missing (Debian: glslang-tools)";
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}

}  // namespace
}  // namespace gelatin
