#include "render/image.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "core/file.h"
#include "gelatin/error.h"
#include "support/image_compare.h"

namespace gelatin::render {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Noise, so that any mix-up shows and nothing can be compressed.
Image pattern(int width, int height) {
    Image image(width, height);
    std::uint32_t state = 1;
    for (std::uint8_t& value : image.pixels) {
        state = state * 1664525u + 1013904223u;
        value = static_cast<std::uint8_t>(state >> 24);
    }
    return image;
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ImageTest, PngGivesBackEachPixel) {
    const TemporaryFolder folder;
    const Image image = pattern(13, 7);
    write_png(folder.path() / "a.png", image);
    const Image back = read_png(folder.path() / "a.png");
    EXPECT_EQ(back.width, 13);
    EXPECT_EQ(back.height, 7);
    EXPECT_EQ(back.pixels, image.pixels);
    EXPECT_EQ(files_in(folder.path()), 1u) << "no partial file stays";
}

TEST(ImageTest, WritingIntoNoFolderIsAnError) {
    const TemporaryFolder folder;
    try {
        write_png(folder.path() / "missing" / "a.png", pattern(2, 2));
        FAIL() << "expected SystemError";
    } catch (const SystemError& error) {
        EXPECT_THAT(error.what(), HasSubstr("missing/a.png: cannot be written"));
    }
}

// In a separate process: a limit on the size of files simulates a full disk.
TEST(ImageDeathTest, FullDiskIsAnErrorAndLeavesTheOldPicture) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const TemporaryFolder folder;
    const auto body = [&folder] {
        write_png(folder.path() / "a.png", pattern(2, 2));
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_png(folder.path() / "a.png", pattern(100, 100));
        } catch (const SystemError& error) {
            const bool kept = read_png(folder.path() / "a.png").width == 2 && files_in(folder.path()) == 1;
            std::fprintf(stderr, "%s, %s", error.what(), kept ? "kept" : "lost");
            ::_exit(3);
        }
        ::_exit(0);
    };
    EXPECT_EXIT(body(), ::testing::ExitedWithCode(3), "a.png: cannot be written: File too large, kept");
}

TEST(ImageTest, ReadingWhatIsNoPngSaysSo) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.png";
    std::ofstream(file) << "no picture";
    try {
        read_png(file);
        FAIL() << "expected InvalidInput";
    } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr("is not a PNG picture"));
    }
    EXPECT_THROW(read_png(folder.path() / "missing.png"), InvalidInput);
}

TEST(ImageTest, ReadingAPngThatIsCutOffIsAnError) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.png";
    write_png(file, pattern(64, 64));
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_THROW(read_png(file), InvalidInput);
}

TEST(ImageTest, PerceptualDifferenceForgivesShiftsButNotColors) {
    Image black(64, 64);
    Image shifted = black;
    Image bright = black;
    for (int y = 0; y < 64; ++y) {
        for (int c = 0; c < 3; ++c) {
            black.at(20, y)[c] = 255;
            shifted.at(21, y)[c] = 255;
        }
        for (int x = 0; x < 64; ++x) bright.at(x, y)[1] = 30;
    }
    EXPECT_EQ(test::perceptual_difference(black, black), 0.0);
    EXPECT_LT(test::perceptual_difference(black, shifted), 0.5);
    EXPECT_GT(test::perceptual_difference(black, bright), 9.0);
}

}  // namespace
}  // namespace gelatin::render
