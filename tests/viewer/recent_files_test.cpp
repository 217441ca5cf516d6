#include "viewer/recent_files.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/file.h"
#include "support/environment.h"

namespace gelatin::viewer {
namespace {

namespace fs = std::filesystem;
using Files = RecentFiles::Files;
using testing::ElementsAre;
using testing::IsEmpty;

class RecentFilesTest : public testing::Test {
protected:
    fs::path path(const std::string& name) const { return folder_.path() / name; }
    Files make(const std::vector<std::string>& names) const {
        Files files;
        for (const std::string& name : names) {
            write_file(path(name), "x");
            files.push_back(path(name));
        }
        return files;
    }
    std::vector<Files> read_again() const { return RecentFiles(list_).all(); }

private:
    const TemporaryFolder folder_;

protected:
    const fs::path list_ = folder_.path() / "state" / "gelatin" / "recent";
};

TEST_F(RecentFilesTest, RemembersTheNewestFirst) {
    RecentFiles recent(list_);
    EXPECT_THAT(recent.all(), IsEmpty());
    const Files scene = make({"a scene.toml"}), meshes = make({"b.obj", "c.obj"});
    recent.add(scene);
    recent.add(meshes);
    EXPECT_THAT(read_again(), ElementsAre(meshes, scene));
    recent.add(scene);
    EXPECT_THAT(recent.all(), ElementsAre(scene, meshes));
    EXPECT_THAT(read_again(), ElementsAre(scene, meshes));
}

TEST_F(RecentFilesTest, KeepsADozen) {
    RecentFiles recent(list_);
    for (int i = 0; i < 20; ++i) recent.add(make({fmt::format("{}.toml", i)}));
    ASSERT_EQ(read_again().size(), 12u);
    EXPECT_EQ(read_again().front().front().filename(), "19.toml");
    EXPECT_EQ(read_again().back().front().filename(), "8.toml");
}

TEST_F(RecentFilesTest, PathsAreAbsolute) {
    RecentFiles recent(list_);
    make({"here.toml"});
    const fs::path before = fs::current_path();
    fs::current_path(path(""));
    recent.add({"./here.toml"});
    fs::current_path(before);
    ASSERT_EQ(recent.all().size(), 1u);
    EXPECT_TRUE(recent.all()[0][0].is_absolute());
    EXPECT_TRUE(fs::equivalent(recent.all()[0][0], path("here.toml")));
}

TEST_F(RecentFilesTest, ForgetsWhatItCannotWriteInALine) {
    RecentFiles recent(list_);
    recent.add(make({"two\nlines.toml"}));
    recent.add(make({"a\ttab.toml"}));
    recent.add({path("not there.toml")});
    recent.add({"/dev/null"});
    EXPECT_THAT(recent.all(), IsEmpty());
    EXPECT_FALSE(fs::exists(list_));
}

TEST_F(RecentFilesTest, KeepsFilesThatAreGone) {
    RecentFiles(list_).add(make({"gone.toml"}));
    fs::remove(path("gone.toml"));
    EXPECT_EQ(read_again().size(), 1u);  // a disk may be plugged in again
}

TEST_F(RecentFilesTest, IgnoresLinesThatMakeNoSense) {
    fs::create_directories(list_.parent_path());
    write_file(list_, std::string("relative.toml\n\n/a/b.toml\t\n/\n\0\1\2\n/good one.toml\n/x\t/y", 52));
    EXPECT_THAT(read_again(), ElementsAre(Files{"/a/b.toml"}, Files{"/good one.toml"}, Files{"/x", "/y"}));
}

TEST_F(RecentFilesTest, TakesAnyBytesInItsStride) {
    fs::create_directories(list_.parent_path());
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        std::string bytes(random() % 3000, '\0');
        for (char& byte : bytes) byte = "/\n\ta.\xff\0"[random() % 7];
        write_file(list_, bytes);
        EXPECT_LE(read_again().size(), 12u);
    }
    write_file(list_, std::string(std::size_t{2} << 20, '/'));
    EXPECT_THAT(read_again(), IsEmpty()) << "no list of a dozen files";
    fs::remove(list_);
    fs::create_directory(list_);
    EXPECT_THAT(read_again(), IsEmpty());
    RecentFiles recent(list_);
    recent.add(make({"a.toml"}));  // a warning
    EXPECT_EQ(recent.all().size(), 1u);
}

TEST_F(RecentFilesTest, LiesWhereTheSystemKeepsState) {
    {
        const test::EnvironmentVariable state("XDG_STATE_HOME", "/some/state");
        EXPECT_EQ(RecentFiles::default_file(), "/some/state/gelatin/recent");
    }
    const test::EnvironmentVariable state("XDG_STATE_HOME", ""), home("HOME", "/some/home");
    EXPECT_EQ(RecentFiles::default_file(), "/some/home/.local/state/gelatin/recent");
}

}  // namespace
}  // namespace gelatin::viewer
