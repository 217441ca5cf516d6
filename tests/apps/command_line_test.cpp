#include <gelatin/version.h>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class CommandLine : public ProgramTest {};

TEST_F(CommandLine, TellsItsVersion) {
    const ProgramResult result = run({"--version"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.out, std::string("gelatin ") + version() + " (" + commit() + ")\n");
}

TEST_F(CommandLine, HelpShowsEveryCommandAndOption) {
    EXPECT_EQ(run({"--help"}).exit_code, 0);
    const std::string help = run({"--help"}).out;
    for (const char* command : {"run", "view", "mesh", "bench", "info", "sweep"})
        EXPECT_THAT(help, HasSubstr(std::string("\n  ") + command));
    const std::string run_help = run({"run", "--help"}).out;
    for (const char* option : {"--frames", "--backend", "--set", "--stats", "--image", "--video", "--export",
                               "--format", "--every", "--checkpoint", "--checkpoint-every", "--resume",
                               "--size", "--device", "--quiet", "--gl-debug"}) {
        EXPECT_THAT(run_help, HasSubstr(std::string("\n  ") + option + " ")) << option;
    }
}

TEST_F(CommandLine, RefusesCallsThatAreWrong) {
    expect_error({}, 2, "A subcommand is required (see gelatin --help)");
    expect_error({"rn", "cube.toml"}, 2,
                 "there is no command \"rn\" (did you mean \"run\"?); there are run, render, export, view, "
                 "mesh, info, bench and sweep");
    expect_error({"run"}, 2, "FILE is required (see gelatin run --help)");
    expect_error({"run", "cube.toml", "--image"}, 2,
                 "--image: 1 required FILE.png missing (see gelatin run --help)");
    EXPECT_EQ(run({"run", "cube.toml", "--fraems", "3"}).exit_code, 2);
    EXPECT_EQ(run({"run", "cube.toml", "--frames", "many"}).exit_code, 2);
    EXPECT_EQ(run({"run", "cube.toml", "--frames", "-1"}).exit_code, 2);
    EXPECT_EQ(run({"run", "cube.toml", "--every", "0"}).exit_code, 2);
    EXPECT_EQ(run({"run", "cube.toml", "--format", "obj"}).exit_code, 2);          // without --export
    EXPECT_EQ(run({"run", "cube.toml", "--checkpoint-every", "3"}).exit_code, 2);  // without --checkpoint
}

TEST_F(CommandLine, NamesFileLineKeyAndValueOfAWrongScene) {
    write("wrong.toml", "[simulation]\nframe_rate = 0\n");
    expect_error({"run", "wrong.toml"}, 2, "wrong.toml:2: simulation.frame_rate = 0: must be greater than 0");
    write("empty.toml", "");
    expect_error({"run", "empty.toml"}, 2, "empty.toml: has no objects: add an [[object]] or a [[rigid]]");
    expect_error({"run", "nothing.toml"}, 2, "nothing.toml: no such file");
    expect_error({"run", "cube.toml", "--set", "material.jelly.density=-3"}, 2,
                 "--set material.jelly.density=-3: material.jelly.density = -3: must be greater than 0");
}

TEST_F(CommandLine, NamesTheMeshThatIsWrong) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n");
    write("open.toml",
          "material = [{name = 'm'}]\n[[object]]\nname = 'thing'\nshape = {file = 'open.obj'}\n"
          "mesher = {kind = 'tetgen'}\n");
    const ProgramResult result = run({"run", "open.toml"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, StartsWith("gelatin: error: "));
    EXPECT_THAT(result.err, HasSubstr("not closed"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

// Python gets all that follows, options of the same names as the program's own, too.
TEST_F(CommandLine, SweepsAreLeftToPython) {
    write("python", "#!/bin/sh\nshift 2\necho \"$@\"\nexit 5\n");
    std::filesystem::permissions(path("python"), std::filesystem::perms::owner_all);
    settings_.environment.push_back("GELATIN_PYTHON=" + path("python").string());
    const ProgramResult result =
        run({"sweep", "cube.toml", "--vary", "a=1,2", "--help", "--version", "--out", "x"});
    EXPECT_EQ(result.out, "cube.toml --vary a=1,2 --help --version --out x\n");
    EXPECT_EQ(result.exit_code, 5);
    settings_.environment.back() = "GELATIN_PYTHON=no_such_program";
    expect_error(
        {"sweep", "cube.toml"}, 1,
        "sweep needs the Python package, and no_such_program cannot be run: No such file or directory");
}

}  // namespace
}  // namespace gelatin::test
