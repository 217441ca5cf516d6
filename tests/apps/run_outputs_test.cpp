#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "apps/program_test.h"

namespace gelatin::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// Outputs that are no regular files.
class RunOutputs : public ProgramTest {
protected:
    // What comes out of a pipe while `arguments` run.
    std::string read_pipe(const std::string& name, const std::vector<std::string>& arguments) {
        EXPECT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
        std::string content;
        std::thread reader([&] {
            std::ifstream stream(path(name), std::ios::binary);
            content.assign(std::istreambuf_iterator<char>(stream), {});
        });
        const ProgramResult result = run(arguments);
        // So that a program that never opened the pipe does not leave its reader waiting.
        if (result.exit_code != 0) std::ofstream{path(name)};
        reader.join();
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_TRUE(fs::is_fifo(path(name))) << "replaced";
        return content;
    }
};

class RunOutputsDraws : public DrawingProgramTest {};

TEST_F(RunOutputs, StatisticsGoToStandardOutputAlone) {
    for (const char* name : {"-", "/dev/stdout"}) {
        const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--stats", name});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(json::parse(result.out)["frames"].size(), 21u) << name;
        EXPECT_THAT(result.err, HasSubstr("20 frames of 1 object (")) << "the summary gives way to them";
    }
    EXPECT_FALSE(exists("-"));
    EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
}

TEST_F(RunOutputs, StatisticsGoThroughAPipe) {
    EXPECT_EQ(json::parse(
                  read_pipe("pipe", {"run", "cube.toml", "--backend", "cpu", "--stats", "pipe"}))["backend"],
              "cpu");
}

TEST_F(RunOutputs, ADeviceStaysOne) {
    EXPECT_EQ(run({"run", "cube.toml", "--backend", "cpu", "--stats", "/dev/null"}).exit_code, 0);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    const ProgramResult full =
        run({"run", "cube.toml", "--backend", "cpu", "--quiet", "--stats", "/dev/full"});
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_EQ(full.err, "gelatin: error: /dev/full: cannot be written: No space left on device\n");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(RunOutputs, LinksStayAndLeadToWhatIsWritten) {
    write("first.json", "{}");
    fs::create_symlink("first.json", path("stats"));
    fs::create_symlink("later.state", path("checkpoint"));
    const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--stats", "stats",
                                      "--checkpoint", "checkpoint", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::is_symlink(path("stats")) && fs::is_symlink(path("checkpoint")));
    EXPECT_EQ(read_json("first.json")["frames"].size(), 21u);
    EXPECT_TRUE(exists("later.state"));
    EXPECT_THAT(partial_files(), IsEmpty());
}

TEST_F(RunOutputs, ALinkIntoAMissingFolderIsRefusedBeforeAnyWork) {
    fs::create_symlink("no/such/file", path("stats"));
    const ProgramResult result = run({"run", "cube.toml", "--stats", "stats"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("--stats = stats: there is no folder"));
}

TEST_F(RunOutputs, MeshesGoThroughAPipeWhoseNameSaysTheFormat) {
    write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    EXPECT_THAT(read_pipe("out.off", {"mesh", "box.obj", "-o", "out.off"}), StartsWith("OFF"));
    expect_error({"mesh", "box.obj", "-o", "-"}, 2,
                 "-o = -: must end in .node, .ele, .mesh, .msh, .vtu, .obj, .stl, .ply or .off");
}

TEST_F(RunOutputsDraws, PicturesAndFilmsGoToStandardOutput) {
    const std::vector<std::string> common = {"run", "cube.toml", "--backend", "cpu",    "--frames",
                                             "3",   "--size",    "64x48",     "--quiet"};
    const auto with = [&](const char* option, const char* file) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {option, file});
        return run(arguments);
    };
    const ProgramResult picture = with("--image", "-");
    ASSERT_EQ(picture.exit_code, 0) << picture.err;
    EXPECT_THAT(picture.out, StartsWith("\x89PNG\r\n"));
    const ProgramResult film = with("--video", "/dev/stdout");
    ASSERT_EQ(film.exit_code, 0) << film.err;
    EXPECT_EQ(film.out.substr(4, 4), "ftyp");
    EXPECT_THAT(partial_files(), IsEmpty());
}

TEST_F(RunOutputsDraws, AFilmReplacesWhatItsLinkLeadsTo) {
    fs::create_symlink("film.mp4", path("link.mp4"));
    const ProgramResult result = run({"run", "cube.toml", "--backend", "cpu", "--frames", "3", "--size",
                                      "64x48", "--quiet", "--video", "link.mp4"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::is_symlink(path("link.mp4")));
    EXPECT_TRUE(fs::is_regular_file(path("film.mp4")));
}

// A slip of the hand must not cost a scene, a mesh or another output.
TEST_F(RunOutputs, DoNotReplaceWhatIsReadOrEachOther) {
    write("ball.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write("ball.toml", "[[material]]\nname = 'm'\n[[object]]\nname = 'o'\nshape = { file = 'ball.obj' }\n");
    const auto refusal = [&](const std::vector<std::string>& arguments) {
        const ProgramResult result = run(arguments);
        EXPECT_NE(result.exit_code, 0);
        return result.err;
    };
    EXPECT_THAT(refusal({"run", "cube.toml", "--stats", "cube.toml"}),
                HasSubstr("cube.toml: is what the run is made from; --stats would replace it"));
    EXPECT_THAT(refusal({"run", "ball.toml", "--checkpoint", "ball.obj"}),
                HasSubstr("ball.obj: is what the run is made from; --checkpoint would replace it"));
    EXPECT_THAT(refusal({"run", "cube.toml", "--stats", "./a.ck", "--checkpoint", "a.ck"}),
                HasSubstr("a.ck: --stats and --checkpoint would write the same file"));
    EXPECT_EQ(run({"run", "cube.toml", "--backend", "cpu", "--checkpoint", "a.ck"}).exit_code, 0);
    EXPECT_EQ(run({"run", "cube.toml", "--backend", "cpu", "--frames", "21", "--resume", "a.ck",
                   "--checkpoint", "a.ck"})
                  .exit_code,
              0);
}

}  // namespace
}  // namespace gelatin::test
