#include <csignal>

#include "apps/program_test.h"
#include "core/file.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class PlayCommands : public ProgramTest {};
class PlayCommandsDraw : public DrawingProgramTest {};

TEST_F(PlayCommands, ARecordingIsExportedAsTheRunWas) {
    const ProgramResult run_result = run(
        {"run", "cube.toml", "--backend", "cpu", "--record", "cube.gel", "--export", "live", "--every", "5"});
    ASSERT_EQ(run_result.exit_code, 0) << run_result.err;
    EXPECT_THAT(run_result.out, HasSubstr("recording: cube.gel"));
    const ProgramResult result = run({"export", "cube.gel", "played", "--format", "vtu"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("5 frames of cube.gel\nframes: played\n"));
    for (const char* name : {"frame_000000.vtu", "frame_000010.vtu", "frame_000020.vtu", "scene.pvd"})
        EXPECT_EQ(read_file(path("live") / name), read_file(path("played") / name)) << name;
    ASSERT_EQ(run({"export", "cube.gel", "cube.glb", "--from", "5", "--to", "15", "--quiet"}).exit_code, 0);
    EXPECT_EQ(read_file(path("cube.glb")).substr(0, 4), "glTF");
}

// Whatever frame comes first, it is the first one that is exported.
TEST_F(PlayCommands, EveryCountsFromTheFirstFrameThatIsPlayed) {
    ASSERT_EQ(run({"run", "cube.toml", "--backend", "cpu", "--record", "cube.gel"}).exit_code, 0);
    for (const char* name : {"cube.glb", "cube.usda", "cube.pc2", "cube.mdd"}) {
        const ProgramResult result =
            run({"export", "cube.gel", name, "--from", "1", "--to", "2", "--every", "5"});
        EXPECT_EQ(result.exit_code, 0) << name << result.err;
        EXPECT_TRUE(exists(name)) << name;
    }
    ASSERT_EQ(run({"export", "cube.gel", "out", "--from", "3", "--every", "7"}).exit_code, 0);
    for (const char* name : {"frame_000003.vtu", "frame_000010.vtu", "frame_000017.vtu"})
        EXPECT_TRUE(exists("out/" + std::string(name))) << name;
    EXPECT_FALSE(exists("out/frame_000007.vtu"));
}

// Between the frames that are due.
TEST_F(PlayCommands, ARunWithoutAFrameThatIsDueHasAnAnimation) {
    ASSERT_EQ(run({"run", "cube.toml", "--backend", "cpu", "--frames", "7", "--checkpoint", "c"}).exit_code,
              0);
    const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--frames", "9", "--resume",
                                      "c", "--every", "10", "--animation", "cube.glb"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(exists("cube.glb"));
}

TEST_F(PlayCommands, ARunContinuesFromAFrame) {
    ASSERT_EQ(
        run({"run", "cube.toml", "--backend", "cpu", "--record", "cube.gel", "--checkpoint", "a"}).exit_code,
        0);
    const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--resume", "cube.gel",
                                      "--resume-frame", "7", "--checkpoint", "b"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_file(path("a")), read_file(path("b")));
    EXPECT_THAT(run({"run", "cube.toml", "--resume", "cube.gel", "--resume-frame", "70"}).err,
                HasSubstr("cube.gel: frame = 70: is not recorded; there are 21 from 0 to 20"));
}

// Somebody was sent the recording, and nothing else.
TEST_F(PlayCommands, ARecordingIsAllThatIsNeeded) {
    write("wedge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write("wedge.toml",
          "[simulation]\nsolver = 'semi_implicit_euler'\n"  // goes on with the same numbers from any frame
          "[[material]]\nname = 'jelly'\n[[object]]\nname = 'wedge'\nshape = { file = 'wedge.obj' }\n"
          "mesher = { nodes = 50 }\nposition = [0, 1, 0]\n[[collider]]\nshape = { plane = [0, 1, 0] }\n");
    const ProgramResult recorded =
        run({"run", "wedge.toml", "--backend", "cpu", "--frames", "12", "--record", "wedge.gel", "--export",
             "live", "--every", "1", "--checkpoint", "a"});
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    for (const char* name : {"wedge.obj", "wedge.toml"}) std::filesystem::remove(path(name));
    std::filesystem::remove_all(path("cache"));
    std::filesystem::create_directory(path("other"));
    std::filesystem::rename(path("wedge.gel"), path("other/wedge.gel"));

    const ProgramResult exported = run({"export", "other/wedge.gel", "played"});
    ASSERT_EQ(exported.exit_code, 0) << exported.err;
    for (const char* name : {"frame_000000.vtu", "frame_000012.vtu"})
        EXPECT_EQ(read_file(path("live") / name), read_file(path("played") / name)) << name;
    for (const std::vector<std::string>& from :
         {std::vector<std::string>{"--resume-frame", "5"},
          std::vector<std::string>{"--resume", "other/wedge.gel", "--resume-frame", "5"}}) {
        std::vector<std::string> arguments{"run", "other/wedge.gel", "--backend", "cpu", "--checkpoint", "b"};
        arguments.insert(arguments.end(), from.begin(), from.end());
        const ProgramResult resumed = run(arguments);
        ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
        EXPECT_EQ(read_file(path("a")), read_file(path("b")));
        std::filesystem::remove(path("b"));
    }
    const ProgramResult anew = run({"run", "other/wedge.gel", "--backend", "cpu", "--checkpoint", "b"});
    ASSERT_EQ(anew.exit_code, 0) << anew.err;
    EXPECT_EQ(read_file(path("a")), read_file(path("b")));
}

TEST_F(PlayCommands, WhatAKilledRunHasWrittenOpens) {
    ProgramSettings settings = settings_;
    settings.signal_after = "10%";
    settings.signals = {SIGKILL};
    settings.signal_delay = std::chrono::milliseconds(20);
    const ProgramResult killed = run_gelatin(
        {"run", "cube.toml", "--backend", "cpu", "--frames", "200000", "--record", "cube.gel"}, settings);
    ASSERT_EQ(killed.signal, SIGKILL);
    const ProgramResult result = run({"export", "cube.gel", "cube.pc2", "--every", "1000"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("frames of cube.gel"));
}

TEST_F(PlayCommands, WrongInputIsOneLine) {
    ASSERT_EQ(
        run({"run", "cube.toml", "--backend", "cpu", "--frames", "2", "--record", "cube.gel"}).exit_code, 0);
    const auto expect_error = [&](const std::vector<std::string>& arguments, const std::string& problem) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << problem;
        EXPECT_THAT(result.err, HasSubstr(problem));
        EXPECT_THAT(result.out, IsEmpty());
    };
    expect_error({"export", "cube.toml", "out"}, "cube.toml: is not a recording of Gelatin");
    expect_error({"export", "none.gel", "out"}, "none.gel: no such file");
    expect_error({"export", "cube.gel", "out", "--from", "3"},
                 "no such frames are recorded; there are those from 0 to 2");
    expect_error({"render", "cube.gel"}, "nothing to make");
    expect_error({"run", "cube.gel", "cube.gel"},
                 "cube.gel: is a recording, which is played or simulated alone");
    expect_error({"run", "cube.gel", "--up", "z"},
                 "cube.gel: is a recording; --up, --keep-units and --nodes");
    expect_error({"run", "cube.toml", "--resume-frame", "3"},
                 "--resume-frame: needs --resume, or a recording to simulate");
    expect_error({"run", "cube.gel", "--record", "cube.gel"},
                 "cube.gel: is what the run is made from; --record would replace it");
    expect_error({"run", "cube.toml", "--record", "cube.mp4"}, "must end in .gel");
}

TEST_F(PlayCommandsDraw, ARecordingIsDrawnAsTheRunWas) {
    const ProgramResult run_result = run({"run", "cube.toml", "--backend", "cpu", "--frames", "6", "--record",
                                          "cube.gel", "--image", "live.png", "--size", "64x64"});
    ASSERT_EQ(run_result.exit_code, 0) << run_result.err;
    const ProgramResult result = run({"render", "cube.gel", "--image", "played.png", "--size", "64x64"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_file(path("live.png")), read_file(path("played.png")));
    // With a film, the picture has its camera.
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"run", "cube.toml", "--backend", "cpu", "--frames", "6"},
          {"render", "cube.gel"}}) {
        std::vector<std::string> arguments = command;
        const std::string name = command[0] == "run" ? "filmed" : "played";
        for (const std::string& more : {std::string("--image"), name + ".png", std::string("--video"),
                                        name + ".mp4", std::string("--size"), std::string("64x64")})
            arguments.push_back(more);
        ASSERT_EQ(run(arguments).exit_code, 0);
    }
    EXPECT_EQ(read_file(path("filmed.png")), read_file(path("played.png")));
    EXPECT_NE(read_file(path("filmed.png")), read_file(path("live.png")));
    EXPECT_GT(std::filesystem::file_size(path("played.mp4")), 0u);
    ASSERT_EQ(run({"render", "cube.gel", "--from", "6", "--image", "alone.png", "--size", "64x64"}).exit_code,
              0);
    EXPECT_EQ(read_file(path("live.png")), read_file(path("alone.png")));
}

}  // namespace
}  // namespace gelatin::test
