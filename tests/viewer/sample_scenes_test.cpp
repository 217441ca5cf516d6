#include "viewer/sample_scenes.h"

#include <gtest/gtest.h>

#include "core/file.h"
#include "render/image.h"
#include "support/source_path.h"

namespace gelatin::viewer {
namespace {

namespace fs = std::filesystem;

TEST(SampleScenes, EachHasALineAndAPicture) {
    const std::vector<SampleScene> scenes = sample_scenes();
    EXPECT_GT(scenes.size(), 20u);
    std::uintmax_t bytes = 0;
    for (const SampleScene& scene : scenes) {
        EXPECT_GT(scene.line.size(), 20u) << scene.file;
        EXPECT_EQ(scene.line.back(), '.') << scene.file;
        ASSERT_TRUE(fs::exists(scene.picture)) << scene.picture << ": scripts/make_gallery makes it";
        const render::Image picture = render::read_png(scene.picture);
        EXPECT_EQ(picture.width, 320) << scene.picture;
        EXPECT_EQ(picture.height, 180) << scene.picture;
        bytes += fs::file_size(scene.picture);
    }
    EXPECT_LT(bytes, 1'000'000u) << "of all pictures";
}

TEST(SampleScenes, ThoseOfTheFolderHereComeFirst) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "scenes");
    write_file(folder.path() / "scenes" / "b.toml", "[simulation]\n");
    write_file(folder.path() / "scenes" / "a.toml", "# It falls.\n");
    write_file(folder.path() / "scenes" / "notes.txt", "# None.\n");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const std::vector<SampleScene> scenes = sample_scenes();
    fs::current_path(before);
    ASSERT_EQ(scenes.size(), 2u);
    EXPECT_EQ(scenes[0].file, "scenes/a.toml");
    EXPECT_EQ(scenes[0].line, "It falls.");
    EXPECT_EQ(scenes[0].picture, "scenes/pictures/a.png");
    EXPECT_EQ(scenes[1].line, "");
}

TEST(SampleScenes, TheLineIsTheFirstSentence) {
    EXPECT_EQ(first_sentence("# One. Two.\n"), "One.");
    EXPECT_EQ(first_sentence("# It goes on in\n# the next line. No more.\n# [x]\n"),
              "It goes on in the next line.");
    EXPECT_EQ(first_sentence("# Of the paper (4.2): `a.toml` is 1.5 m.\r\n\r\n# Other."),
              "Of the paper (4.2): `a.toml` is 1.5 m.");
    EXPECT_EQ(first_sentence("# no end\n[simulation] # else"), "no end");
    EXPECT_EQ(first_sentence("[simulation]\n# late"), "");
    EXPECT_EQ(first_sentence(""), "");
    EXPECT_EQ(first_sentence("#\n# late"), "");
}

}  // namespace
}  // namespace gelatin::viewer
