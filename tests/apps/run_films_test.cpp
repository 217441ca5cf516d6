#include <csignal>

#include "apps/program_test.h"
#include "render/image.h"

namespace gelatin::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class RunCommandFilms : public DrawingProgramTest {
protected:
    // "width,height,rate,frames" of a film.
    std::string probe(const std::string& name) const {
        const ProgramResult result = run_program(
            {"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
             "stream=width,height,avg_frame_rate,nb_read_frames", "-of", "csv=p=0", path(name).string()});
        return result.out;
    }
};

TEST_F(RunCommandFilms, FilmsInRealTime) {
    // 240 frames a second: every fourth is filmed, which plays at 60.
    const ProgramResult result = run({"run", "cube.toml", "--video", "film.mp4", "--size", "160x90", "--set",
                                      "simulation.frame_rate=240", "--frames", "40"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(probe("film.mp4"), "160,90,60/1,11\n");
    EXPECT_THAT(partial_files(), IsEmpty());
}

TEST_F(RunCommandFilms, FilmsEveryKthFrameAtItsOwnRate) {
    const ProgramResult result =
        run({"run", "cube.toml", "--video", "film.mp4", "--size", "160x90", "--every", "3"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(probe("film.mp4"), "160,90,100/3,7\n");
}

// Frames are drawn while the CPU simulates the next one, which must not show in what is simulated.
TEST_F(RunCommandFilms, FilmingChangesNoNumber) {
    const std::vector<std::string> plain{"run", "cube.toml", "--backend", "cpu", "--quiet"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), plain.begin(), plain.end());
        EXPECT_EQ(run(more).exit_code, 0);
    };
    with({"--stats", "a.json", "--checkpoint", "a"});
    with({"--stats", "b.json", "--checkpoint", "b", "--checkpoint-every", "3", "--video", "film.mp4",
          "--every", "1", "--size", "160x90", "--export", "out", "--format", "obj"});
    EXPECT_EQ(read_json("a.json")["frames"], read_json("b.json")["frames"]);
    EXPECT_EQ(read_file(path("a")), read_file(path("b")));
    EXPECT_TRUE(exists("out/frame_000020.obj"));
}

// The camera, if the scene has none, is chosen when all is known; nothing is left of what waits for that.
TEST_F(RunCommandFilms, ShowsTheBodyInEachPicture) {
    write("thrown.toml",
          "[simulation]\nframes = 60\n[[material]]\nname = 'jelly'\n[[object]]\nname = 'cube'\n"
          "shape = { box = [1, 1, 1] }\nposition = [0, 1, 0]\nvelocity = [9, 3, 0]\ncolor = [1, 0, 0]\n"
          "[[collider]]\nshape = { box = [40, 1, 4] }\nposition = [15, -0.5, 0]\n");
    const ProgramResult result =
        run({"run", "thrown.toml", "--video", "film.mp4", "--image", "end.png", "--size", "160x90"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(probe("film.mp4"), "160,90,60/1,61\n");
    for (const auto& entry : std::filesystem::directory_iterator(path(".")))
        EXPECT_NE(entry.path().extension(), ".gel") << entry.path();
    ASSERT_EQ(
        run_program({"ffmpeg", "-v", "error", "-i", path("film.mp4").string(), path("p%d.png").string()})
            .exit_code,
        0);
    for (const char* name : {"p1.png", "p30.png", "p61.png", "end.png"}) {
        const render::Image image = render::read_png(path(name));
        int red = 0, red_at_edges = 0;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* pixel = image.at(x, y);
                if (pixel[0] < 2 * pixel[1]) continue;
                ++red;
                red_at_edges += x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height;
            }
        }
        EXPECT_GT(red, 40) << name;
        EXPECT_EQ(red_at_edges, 0) << name;
    }
}

TEST_F(RunCommandFilms, AnInterruptFinishesTheFilm) {
    settings_.signal_after = "per frame";
    settings_.signals = {SIGINT};
    const ProgramResult result =
        run({"run", "cube.toml", "--video", "film.mp4", "--size", "160x90", "--frames", "1000000"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(probe("film.mp4"), StartsWith("160,90,50/1,"));
    EXPECT_THAT(partial_files(), IsEmpty());
}

TEST_F(RunCommandFilms, FailsCleanlyOnAFullDisk) {
    // Puts the tets into the cache, whose own writing must not meet the limit first.
    ASSERT_EQ(run({"run", "cube.toml", "--frames", "0", "--quiet"}).exit_code, 0);
    settings_.largest_file = 20'000;
    const ProgramResult result =
        run({"run", "cube.toml", "--video", "film.mp4", "--frames", "200", "--quiet"});
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr("gelatin: error: film.mp4"));
    EXPECT_THAT(partial_files(), IsEmpty());
    EXPECT_FALSE(exists("film.mp4"));
}

TEST_F(RunCommandFilms, SaysSoWhereThereIsNoFfmpeg) {
    // Ready tets, so that no other program is needed.
    write("tet.mesh",
          "MeshVersionFormatted 1\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
          "Tetrahedra 1\n1 2 3 4 0\nEnd\n");
    settings_.environment.emplace_back("PATH=/nonexistent");
    const ProgramResult result = run({"run", "cube.toml", "--video", "film.mp4", "--size", "160x90", "--set",
                                      "object.cube.shape={file='tet.mesh'}"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("ffmpeg"));
    EXPECT_THAT(partial_files(), IsEmpty());
}

}  // namespace
}  // namespace gelatin::test
