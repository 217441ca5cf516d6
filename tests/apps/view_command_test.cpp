#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ViewCommand : public ProgramTest {};

TEST_F(ViewCommand, SaysInOneLineThatThereIsNoDisplay) {
    settings_.environment.emplace_back("DISPLAY=");
    const ProgramResult result = run({"view", "cube.toml"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, StartsWith("gelatin: error: there is no display to open a window on (X11: "));
    EXPECT_THAT(result.err, HasSubstr("gelatin run SCENE --video"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(ViewCommand, RefusesCallsThatAreWrongBeforeItOpensAnything) {
    expect_error({"view", "--quality", "god"}, 2, "--quality = god: must be auto, high or fast");
    EXPECT_EQ(run({"view", "--size", "0x0"}).exit_code, 2);
    expect_error({"view", "another.toml", "cube.toml"}, 2,
                 "another.toml: a scene is simulated alone; several files must all be meshes");
}

}  // namespace
}  // namespace gelatin::test
