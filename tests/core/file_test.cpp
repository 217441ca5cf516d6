#include "core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "gelatin/error.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t entry_count(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

template <class Exception, class Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    ADD_FAILURE() << "did not throw";
    return {};
}

TEST(ReadFile, GivesEveryByteBack) {
    const TemporaryFolder folder;
    const std::string content("a\r\n\0\xff\n", 6);
    write_file(folder.path() / "bytes", content);
    EXPECT_EQ(read_file(folder.path() / "bytes"), content);
}

TEST(ReadFile, ReadsAnEmptyFile) {
    const TemporaryFolder folder;
    write_file(folder.path() / "empty", "");
    EXPECT_EQ(read_file(folder.path() / "empty"), "");
}

TEST(ReadFile, NamesAFileThatIsNotThere) {
    const std::string message = message_of<InvalidInput>([] { read_file("/no/such/file"); });
    EXPECT_EQ(message, "/no/such/file: no such file");
}

TEST(ReadFile, RefusesAFolder) {
    const TemporaryFolder folder;
    EXPECT_THAT(message_of<InvalidInput>([&] { read_file(folder.path()); }), HasSubstr("folder"));
}

TEST(WriteFile, ReplacesWhatWasThere) {
    const TemporaryFolder folder;
    write_file(folder.path() / "name", "a longer first content");
    write_file(folder.path() / "name", "second");
    EXPECT_EQ(read_file(folder.path() / "name"), "second");
    EXPECT_EQ(entry_count(folder.path()), 1u);
}

TEST(WriteFile, SaysWhyItCannot) {
    const std::string message = message_of<SystemError>([] { write_file("/no/such/folder/name", "x"); });
    EXPECT_THAT(message, HasSubstr("/no/such/folder/name"));
    EXPECT_THAT(message, HasSubstr("No such file or directory"));
}

// The target is a folder, so that the last step, the rename, fails.
TEST(WriteFile, LeavesNothingBehindWhereItFails) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "taken");
    message_of<SystemError>([&] { write_file(folder.path() / "taken", "x"); });
    EXPECT_TRUE(fs::is_directory(folder.path() / "taken"));
    EXPECT_EQ(entry_count(folder.path()), 1u);
}

TEST(PartialName, IsHiddenBesideTheFileAndKeepsItsEnding) {
    const fs::path partial = partial_name("/some/folder/film.mp4");
    EXPECT_EQ(partial.parent_path(), "/some/folder");
    EXPECT_EQ(partial.extension(), ".mp4");
    EXPECT_EQ(partial.filename().string().front(), '.');
    EXPECT_THAT(partial.filename().string(), HasSubstr("partial"));
}

TEST(TemporaryFolderTest, IsPrivateAndRemovedWithItsContent) {
    fs::path path;
    {
        const TemporaryFolder folder, other;
        path = folder.path();
        EXPECT_NE(path, other.path());
        EXPECT_EQ(fs::status(path).permissions() & fs::perms::mask, fs::perms::owner_all);
        fs::create_directory(path / "inner");
        std::ofstream(path / "inner" / "file") << "x";
    }
    EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace gelatin
