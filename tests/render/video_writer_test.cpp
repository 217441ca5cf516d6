#include "render/video_writer.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/file.h"
#include "gelatin/error.h"
#include "support/environment.h"

namespace gelatin::render {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class VideoWriterTest : public ::testing::Test {
protected:
    TemporaryFolder folder_;

    void SetUp() override {
        if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
    }

    static Image frame(int width, int height, int number) {
        Image image(width, height);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            image.pixels[i] = static_cast<std::uint8_t>(i / 3 + static_cast<std::size_t>(number) * 20);
        }
        return image;
    }

    static bool is_empty(const fs::path& folder) { return fs::is_empty(folder); }

    // "width,height,r_frame_rate,nb_read_frames" of the film.
    std::string probe(const fs::path& file) const {
        const ProcessResult result = run_process(
            {"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
             "stream=width,height,pix_fmt,r_frame_rate,nb_read_frames", "-of", "csv=p=0", file.string()},
            folder_.path(), 60.0);
        return result.output;
    }
};

TEST_F(VideoWriterTest, WritesEveryFrameAtTheRateGiven) {
    const fs::path file = folder_.path() / "film.mp4";
    VideoWriter writer(file, 64, 48, FrameRate::from(29.97));
    for (int i = 0; i < 7; ++i) writer.write(frame(64, 48, i));
    EXPECT_FALSE(fs::exists(file)) << "nothing under the film's name before it is finished";
    writer.finish();
    EXPECT_EQ(probe(file), "64,48,yuv420p,2997/100,7\n");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(VideoWriterTest, OddSizesGrowByOnePixel) {
    const fs::path file = folder_.path() / "odd.mkv";
    VideoWriter writer(file, 33, 17, {60, 1});
    writer.write(frame(33, 17, 0));
    writer.finish();
    EXPECT_THAT(probe(file), HasSubstr("34,18,yuv420p"));
}

TEST_F(VideoWriterTest, ColorsComeThrough) {
    const fs::path file = folder_.path() / "film.mp4";
    Image orange(32, 32);
    for (int i = 0; i < 32 * 32; ++i) {
        orange.pixels[3 * static_cast<std::size_t>(i)] = 220;
        orange.pixels[3 * static_cast<std::size_t>(i) + 1] = 120;
        orange.pixels[3 * static_cast<std::size_t>(i) + 2] = 40;
    }
    VideoWriter writer(file, 32, 32, {60, 1});
    for (int i = 0; i < 3; ++i) writer.write(orange);
    writer.finish();
    // Raw, for PNG would carry the film's transfer curve and read_png undo it.
    const fs::path raw = folder_.path() / "frame.rgb";
    const ProcessResult result =
        run_process({"ffmpeg", "-v", "error", "-i", file.string(), "-frames:v", "1", "-vf",
                     "scale=in_color_matrix=bt709", "-pix_fmt", "rgb24", "-f", "rawvideo", raw.string()},
                    folder_.path(), 60.0);
    ASSERT_TRUE(result.succeeded()) << result.output;
    const std::string pixels = read_file(raw);
    ASSERT_EQ(pixels.size(), 3u * 32 * 32);
    EXPECT_NEAR(static_cast<std::uint8_t>(pixels[1500]), 220, 4);
    EXPECT_NEAR(static_cast<std::uint8_t>(pixels[1501]), 120, 4);
    EXPECT_NEAR(static_cast<std::uint8_t>(pixels[1502]), 40, 4);
}

TEST_F(VideoWriterTest, LeavesNothingUnlessFinished) {
    {
        VideoWriter writer(folder_.path() / "film.mp4", 64, 48, {60, 1});
        for (int i = 0; i < 50; ++i) writer.write(frame(64, 48, i));
    }
    EXPECT_TRUE(is_empty(folder_.path()));
}

TEST_F(VideoWriterTest, AFilmOfNoFramesIsAnError) {
    VideoWriter writer(folder_.path() / "film.mp4", 64, 48, {60, 1});
    EXPECT_THROW(writer.finish(), InvalidInput);
    EXPECT_TRUE(is_empty(folder_.path()));
}

TEST_F(VideoWriterTest, RefusesOtherEndings) {
    try {
        const VideoWriter writer(folder_.path() / "film.gif", 64, 48, {60, 1});
        FAIL() << "expected InvalidInput";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("film.gif: a film's name must end in .mp4, .mov or .mkv"));
    }
}

// Frames until the encoder's end is noticed, then `finish`: one of them must throw.
std::string error_of_film(const fs::path& file) {
    try {
        VideoWriter writer(file, 256, 256, {60, 1});
        Image noise(256, 256);
        unsigned state = 1;
        for (int i = 0; i < 40; ++i) {
            for (std::uint8_t& value : noise.pixels) {
                state = state * 1664525u + 1013904223u;
                value = static_cast<std::uint8_t>(state >> 24);
            }
            writer.write(noise);
        }
        writer.finish();
    } catch (const SystemError& error) {
        return error.what();
    }
    return "no error";
}

TEST_F(VideoWriterTest, NoSuchFolderPassesOnFfmpegsWords) {
    const std::string message = error_of_film(folder_.path() / "missing" / "film.mp4");
    EXPECT_THAT(message, HasSubstr("missing/film.mp4: the film cannot be written: ffmpeg: "));
    EXPECT_THAT(message, HasSubstr("No such file or directory"));
}

TEST_F(VideoWriterTest, NoFfmpegSaysWhatToInstall) {
    const test::EnvironmentVariable path("PATH", folder_.path().string());
    const std::string message = error_of_film(folder_.path() / "film.mp4");
    EXPECT_THAT(message, HasSubstr("film.mp4: cannot be written"));
    EXPECT_THAT(message, HasSubstr("apt install ffmpeg"));
}

// In a separate process: a limit on the size of files simulates a full disk.
TEST_F(VideoWriterTest, FullDiskIsAnErrorAndLeavesNothing) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const TemporaryFolder folder;
    const auto body = [&folder] {
        const rlimit limit{100'000, 100'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const std::string message = error_of_film(folder.path() / "film.mp4");
        std::fprintf(stderr, "%s, %s", message.c_str(), is_empty(folder.path()) ? "empty" : "not empty");
        ::_exit(message == "no error" ? 0 : 3);
    };
    EXPECT_EXIT(body(), ::testing::ExitedWithCode(3), "film.mp4: the film cannot be written: .*, empty");
}

TEST(FrameRateTest, IsTheNearestFractionOfThousandths) {
    EXPECT_EQ(FrameRate::from(60.0).numerator, 60);
    EXPECT_EQ(FrameRate::from(60.0).denominator, 1);
    EXPECT_EQ(FrameRate::from(23.976).numerator, 2997);
    EXPECT_EQ(FrameRate::from(23.976).denominator, 125);
    for (const double rate : {0.0, -1.0, 2e6, std::nan("")})
        EXPECT_THROW(FrameRate::from(rate), InvalidInput) << rate;
}

}  // namespace
}  // namespace gelatin::render
