#include "core/disk_cache.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <thread>

#include "core/file.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

const std::string kKey = "0123456789abcdef0123456789abcdef";

// Content whose every byte depends on `seed`; large enough that a torn entry shows.
std::string make_content(std::uint32_t seed, std::size_t size = 200'000) {
    std::string content(size, '\0');
    for (std::size_t k = 0; k < size; ++k) content[k] = static_cast<char>(seed + k / 256);
    return content;
}

fs::path only_entry(const fs::path& folder) {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    return fs::directory_iterator(folder)->path();
}

TEST(DiskCache, GivesBackWhatWasStored) {
    const TemporaryFolder folder;
    const DiskCache cache(folder.path() / "made" / "on demand", "things");
    EXPECT_FALSE(cache.find(kKey));
    cache.store(kKey, make_content(3));
    EXPECT_EQ(DiskCache(folder.path() / "made" / "on demand", "things").find(kKey), make_content(3));
    EXPECT_FALSE(cache.find("another"));

    cache.store(kKey, make_content(4));
    EXPECT_EQ(cache.find(kKey), make_content(4));
}

TEST(DiskCache, KeepsEmptyContent) {
    const TemporaryFolder folder;
    const DiskCache cache(folder.path(), "things");
    cache.store(kKey, "");
    EXPECT_EQ(cache.find(kKey), "");
}

TEST(DiskCache, AnyFlippedByteIsAMiss) {
    const TemporaryFolder folder;
    const DiskCache cache(folder.path(), "things");
    cache.store(kKey, make_content(1, 50));
    const fs::path entry = only_entry(folder.path());
    const std::string good = read_file(entry);
    for (std::size_t k = 0; k < good.size(); ++k) {
        std::string damaged = good;
        damaged[k] = static_cast<char>(damaged[k] ^ 0x10);
        write_file(entry, damaged);
        EXPECT_FALSE(cache.find(kKey)) << "byte " << k;
    }
    write_file(entry, good);
    EXPECT_TRUE(cache.find(kKey));
}

TEST(DiskCache, CutOffLengthenedOrRenamedEntriesAreMisses) {
    const TemporaryFolder folder;
    const DiskCache cache(folder.path(), "things");
    cache.store(kKey, make_content(1, 500));
    const fs::path entry = only_entry(folder.path());
    const std::string good = read_file(entry);
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{32}, good.size() - 1}) {
        write_file(entry, good.substr(0, size));
        EXPECT_FALSE(cache.find(kKey)) << size << " bytes";
    }
    write_file(entry, good + "x");
    EXPECT_FALSE(cache.find(kKey));
    write_file(folder.path() / ("other" + entry.extension().string()), good);
    EXPECT_FALSE(cache.find("other"));
}

TEST(DiskCache, AFolderThatCannotBeMadeIsNoError) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "in the way");
    const DiskCache cache(folder.path() / "file" / "below", "things");
    EXPECT_NO_THROW(cache.store(kKey, make_content(1)));
    EXPECT_FALSE(cache.find(kKey));
}

// Processes, each of two threads, write different content under one key and read it all the while: what is
// found is always one of them, whole.
TEST(DiskCache, IsSafeForSeveralProcessesAndThreads) {
    const TemporaryFolder folder;
    const DiskCache cache(folder.path(), "things");
    const auto work = [&cache](std::uint32_t seed) {
        for (int round = 0; round < 8; ++round) {
            cache.store(kKey, make_content(seed));
            const std::optional<std::string> found = cache.find(kKey);
            if (!found || found->empty()) return false;
            if (found != make_content(static_cast<unsigned char>(found->front()))) return false;
        }
        return true;
    };
    std::vector<pid_t> children;
    for (std::uint32_t process = 0; process < 3; ++process) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            bool other_is_right = false;
            std::thread other([&] { other_is_right = work(100 + process); });
            const bool is_right = work(200 + process);
            other.join();
            ::_exit(is_right && other_is_right ? 0 : 1);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    only_entry(folder.path());  // and no partial file stays behind
}

TEST(DiskCache, FolderComesFromTheEnvironment) {
    const auto with = [](const char* own, const char* xdg) {
        ::setenv("GELATIN_CACHE_DIR", own, 1);
        ::setenv("XDG_CACHE_HOME", xdg, 1);
        return DiskCache::default_folder();
    };
    const char* old_own = std::getenv("GELATIN_CACHE_DIR");
    const char* old_xdg = std::getenv("XDG_CACHE_HOME");
    const std::string own = old_own == nullptr ? "" : old_own, xdg = old_xdg == nullptr ? "" : old_xdg;
    EXPECT_EQ(with("/own", "/xdg"), "/own");
    EXPECT_EQ(with("", "/xdg"), "/xdg/gelatin");
    EXPECT_EQ(with("", "").filename(), "gelatin");
    with(own.c_str(), xdg.c_str());
}

}  // namespace
}  // namespace gelatin
