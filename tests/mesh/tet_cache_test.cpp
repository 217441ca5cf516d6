#include "mesh/tet_cache.h"

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

// A mesh whose every number tells `seed`; large enough that a torn entry shows.
TetMesh make_mesh(std::uint32_t seed, std::size_t size = 5000) {
    TetMesh mesh;
    for (std::uint32_t k = 0; k < size; ++k) mesh.positions.emplace_back(seed + k, 0.1 * k, -1.0 / (k + 1));
    for (std::uint32_t k = 0; k < 2 * size; ++k) mesh.tets.emplace_back(seed, k, k + 1, k + 2);
    for (std::uint32_t k = 0; k < size / 2; ++k) mesh.faces.emplace_back(k, seed, k + 1);
    return mesh;
}

bool is_same(const std::optional<TetMesh>& found, const TetMesh& mesh) {
    return found && found->positions == mesh.positions && found->tets == mesh.tets &&
           found->faces == mesh.faces;
}

fs::path only_entry(const fs::path& folder) {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    return fs::directory_iterator(folder)->path();
}

TEST(TetCache, GivesBackWhatWasStored) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path() / "made" / "on demand");
    EXPECT_FALSE(cache.find(kKey));
    cache.store(kKey, make_mesh(3));
    EXPECT_TRUE(is_same(TetCache(folder.path() / "made" / "on demand").find(kKey), make_mesh(3)));
    EXPECT_FALSE(cache.find("another"));

    cache.store(kKey, make_mesh(4));
    EXPECT_TRUE(is_same(cache.find(kKey), make_mesh(4)));
}

TEST(TetCache, KeepsAnEmptyMesh) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, {});
    ASSERT_TRUE(cache.find(kKey));
    EXPECT_TRUE(cache.find(kKey)->positions.empty());
}

TEST(TetCache, AnyFlippedByteIsAMiss) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, make_mesh(1, 2));
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

TEST(TetCache, CutOffLengthenedOrRenamedEntriesAreMisses) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, make_mesh(1, 10));
    const fs::path entry = only_entry(folder.path());
    const std::string good = read_file(entry);
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{48}, good.size() - 1}) {
        write_file(entry, good.substr(0, size));
        EXPECT_FALSE(cache.find(kKey)) << size << " bytes";
    }
    write_file(entry, good + "x");
    EXPECT_FALSE(cache.find(kKey));
    write_file(folder.path() / ("other" + entry.extension().string()), good);
    EXPECT_FALSE(cache.find("other"));
}

TEST(TetCache, CountsThatWouldWrapAreAMiss) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, make_mesh(1, 10));
    const fs::path entry = only_entry(folder.path());
    std::string content = read_file(entry);
    content.replace(8, 24, std::string(24, '\xff'));  // the three counts
    write_file(entry, content);
    EXPECT_FALSE(cache.find(kKey));
}

TEST(TetCache, AFolderThatCannotBeMadeIsNoError) {
    const TemporaryFolder folder;
    write_file(folder.path() / "file", "in the way");
    const TetCache cache(folder.path() / "file" / "below");
    EXPECT_NO_THROW(cache.store(kKey, make_mesh(1)));
    EXPECT_FALSE(cache.find(kKey));
}

// Processes, each of two threads, write different meshes under one key and read it all the while: what is
// found is always one of them, whole.
TEST(TetCache, IsSafeForSeveralProcessesAndThreads) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    const auto work = [&cache](std::uint32_t seed) {
        for (int round = 0; round < 8; ++round) {
            cache.store(kKey, make_mesh(seed));
            const std::optional<TetMesh> found = cache.find(kKey);
            if (!found || found->positions.empty()) return false;
            if (!is_same(found, make_mesh(static_cast<std::uint32_t>(found->positions[0].x)))) return false;
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

TEST(TetCache, FolderComesFromTheEnvironment) {
    const auto with = [](const char* own, const char* xdg) {
        ::setenv("GELATIN_CACHE_DIR", own, 1);
        ::setenv("XDG_CACHE_HOME", xdg, 1);
        return TetCache::default_folder();
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
