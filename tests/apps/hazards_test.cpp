#include "gl/hazards.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "apps/program_test.h"
#include "support/run_program.h"
#include "support/source_path.h"

namespace gelatin::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// What the program says of accesses to buffers that no barrier orders (GELATIN_GL_HAZARDS).
class HazardsOfTheProgram : public DrawingProgramTest {
protected:
    void SetUp() override {
        DrawingProgramTest::SetUp();
        write("two.toml",
              "[collision]\nresponse = 'restore'\n[[material]]\nname = 'jelly'\n"
              "[[object]]\nname = 'a'\nshape = { box = [1, 1, 1] }\n"
              "[[object]]\nname = 'b'\nshape = { box = [1, 1, 1] }\nposition = [0, 0.9, 0]\n");
    }

    ProgramResult run_with(const std::string& setting) {
        settings_.environment.push_back("GELATIN_GL_HAZARDS=" + setting);
        return run({"run", "two.toml", "--backend", "gl", "--frames", "1"});
    }

    // Shaders of which each that counts in the arguments of dispatches may write them, too.
    void loosen_a_shader() {
        std::filesystem::copy(source_path("shaders"), path("shaders"),
                              std::filesystem::copy_options::recursive);
        const std::string file = "shaders/sim/collision/dispatches.glsl", word = "readonly ";
        std::string text = read_file(path(file));
        ASSERT_NE(text.find(word), std::string::npos);
        write(file, text.erase(text.find(word), word.size()));
        settings_.environment.push_back("GELATIN_SHADER_DIR=" + path("shaders").string());
    }
};

TEST_F(HazardsOfTheProgram, AreNone) {
    const ProgramResult result = run_with("1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("barrier")));
}

TEST_F(HazardsOfTheProgram, AreAnErrorAtTheEnd) {
    loosen_a_shader();
    const ProgramResult result = run_with("1");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err,
                HasSubstr("gelatin: error: accesses to buffers on the GPU that no barrier orders:"));
    EXPECT_THAT(result.err, HasSubstr("no barrier(command) between"));
}

TEST_F(HazardsOfTheProgram, AreNotLookedForUnlessAskedFor) {
    loosen_a_shader();
    EXPECT_EQ(run_with("0").exit_code, 0);
}

TEST_F(HazardsOfTheProgram, UnneededBarriersAreListedOnRequest) {
    const ProgramResult result = run_with("unneeded");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("is not needed for"));
}

}  // namespace
}  // namespace gelatin::test
