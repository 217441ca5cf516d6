#include "core/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>

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

// What is not a regular file

TEST(WriteFile, ReplacesWhatALinkLeadsToAndKeepsTheLink) {
    const TemporaryFolder folder;
    const fs::path link = folder.path() / "link", middle = folder.path() / "middle",
                   inner = folder.path() / "inner";
    fs::create_directory(inner);
    write_file(inner / "target", "first");
    fs::create_symlink("inner/target", middle);  // relative to where the link is
    fs::create_symlink(middle, link);
    write_file(link, "second");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_symlink(middle));
    EXPECT_EQ(read_file(inner / "target"), "second");
    EXPECT_EQ(entry_count(inner), 1u);
    EXPECT_EQ(entry_count(folder.path()), 3u);
}

TEST(WriteFile, MakesWhatADanglingLinkNames) {
    const TemporaryFolder folder;
    fs::create_symlink("later", folder.path() / "link");
    write_file(folder.path() / "link", "content");
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
    EXPECT_EQ(read_file(folder.path() / "later"), "content");
}

TEST(WriteFile, RefusesLinksThatGoInACircle) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder.path() / "a");
    fs::create_symlink("a", folder.path() / "b");
    EXPECT_THAT(message_of<SystemError>([&] { write_file(folder.path() / "a", "x"); }),
                HasSubstr("cannot be written"));
    EXPECT_EQ(entry_count(folder.path()), 2u);
}

TEST(WriteFile, WritesThroughAPipe) {
    const TemporaryFolder folder;
    const fs::path pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_TRUE(is_stream(pipe));
    std::string read;
    std::thread reader([&] {
        std::ifstream stream(pipe);
        read.assign(std::istreambuf_iterator<char>(stream), {});
    });
    const std::string content(200'000, 'x');  // more than a pipe holds
    write_file(pipe, content);
    reader.join();
    EXPECT_EQ(read, content);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(entry_count(folder.path()), 1u);
}

TEST(WriteFile, WritesThroughADevice) {
    write_file("/dev/null", "content");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(message_of<SystemError>([] { write_file("/dev/full", "content"); }),
              "/dev/full: cannot be written: No space left on device");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// Standard output is a file here, at whose end others have written.
TEST(WriteFile, WritesStandardOutputWhereItStands) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "out";
    std::fflush(stdout);
    const int saved = ::dup(STDOUT_FILENO);
    const int out = ::open(file.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(out, STDOUT_FILENO);
    std::printf("before ");
    write_file("-", "a ");
    write_file("/dev/stdout", "b ");
    std::printf("after");
    std::fflush(stdout);
    ::dup2(saved, STDOUT_FILENO);
    ::close(out);
    ::close(saved);
    EXPECT_EQ(read_file(file), "before a b after");
    EXPECT_EQ(entry_count(folder.path()), 1u);
}

TEST(IsStandardOutput, KnowsItsNames) {
    for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"})
        EXPECT_TRUE(is_standard_output(name)) << name;
    for (const char* name : {"/dev/stderr", "/dev/null", "./-", "stdout", ""})
        EXPECT_FALSE(is_standard_output(name)) << name;
    EXPECT_TRUE(is_stream("/dev/stderr"));
    EXPECT_FALSE(is_stream("/tmp"));
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
