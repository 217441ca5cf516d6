#include "mesh/tet_cache.h"

#include <gtest/gtest.h>

#include "core/file.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

const std::string kKey = "0123456789abcdef0123456789abcdef";

// A mesh whose every number depends on `seed`; large enough that a torn entry shows.
TetMesh make_mesh(std::uint32_t seed, std::size_t size = 5000) {
    TetMesh mesh;
    for (std::uint32_t k = 0; k < size; ++k) mesh.positions.emplace_back(seed + k, 0.1 * k, -1.0 / (k + 1));
    for (std::uint32_t k = 0; k < 2 * size; ++k) mesh.tets.emplace_back(seed, k, k + 1, k + 2);
    for (std::uint32_t k = 0; k < size / 2; ++k) mesh.faces.emplace_back(k, seed, k + 1);
    for (std::uint32_t k = 0; k < 2 * size; ++k) mesh.attributes.push_back(static_cast<int>(k) - 100);
    return mesh;
}

bool is_same(const std::optional<CachedTets>& found, const TetMesh& mesh) {
    return found && found->mesh.positions == mesh.positions && found->mesh.tets == mesh.tets &&
           found->mesh.faces == mesh.faces && found->mesh.attributes == mesh.attributes;
}

fs::path only_entry(const fs::path& folder) {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    return fs::directory_iterator(folder)->path();
}

TEST(TetCache, GivesBackWhatWasStored) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path() / "made" / "on demand");
    EXPECT_FALSE(cache.find(kKey));
    cache.store(kKey, {make_mesh(3)});
    EXPECT_TRUE(is_same(TetCache(folder.path() / "made" / "on demand").find(kKey), make_mesh(3)));
    EXPECT_FALSE(cache.find("another"));

    cache.store(kKey, {make_mesh(4)});
    EXPECT_TRUE(is_same(cache.find(kKey), make_mesh(4)));
}

TEST(TetCache, KeepsNotes) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    const Notes notes = {"parts are missing, 2%", "", "so", warning("but")};
    cache.store(kKey, {make_mesh(1, 10), notes});
    EXPECT_EQ(cache.find(kKey)->notes, notes);
    EXPECT_TRUE(is_same(cache.find(kKey), make_mesh(1, 10)));
}

TEST(TetCache, KeepsFailuresApartFromMeshes) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store_failure(kKey, {"mesher.time_limit", "5 s", "too slow\n; so it is", 5.0});
    EXPECT_FALSE(cache.find(kKey));
    const std::optional<MesherFailure> found = cache.find_failure(kKey);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->field, "mesher.time_limit");
    EXPECT_EQ(found->value, "5 s");
    EXPECT_EQ(found->problem, "too slow\n; so it is");
    EXPECT_EQ(found->retry_above, 5.0);
    EXPECT_FALSE(cache.find_failure("another"));
    cache.store(kKey, {make_mesh(1, 10)});
    EXPECT_TRUE(cache.find_failure(kKey));
    EXPECT_TRUE(is_same(cache.find(kKey), make_mesh(1, 10)));
}

TEST(TetCache, ADamagedFailureIsNone) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store_failure(kKey, {{}, {}, "no", 1.0});
    const fs::path entry = only_entry(folder.path());
    const std::string whole = read_file(entry);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write_file(entry, whole.substr(0, size));
        EXPECT_FALSE(cache.find_failure(kKey)) << size;
    }
}

TEST(TetCache, KeepsAnEmptyMesh) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, {});
    ASSERT_TRUE(cache.find(kKey));
    EXPECT_TRUE(cache.find(kKey)->mesh.positions.empty());
    EXPECT_TRUE(cache.find(kKey)->notes.empty());
}

TEST(TetCache, CutOffOrDamagedEntriesAreMisses) {
    const TemporaryFolder folder;
    const TetCache cache(folder.path());
    cache.store(kKey, {make_mesh(1, 10)});
    const fs::path entry = only_entry(folder.path());
    const std::string good = read_file(entry);
    write_file(entry, good.substr(0, good.size() - 12));
    EXPECT_FALSE(cache.find(kKey));
    write_file(entry, good);
    EXPECT_TRUE(cache.find(kKey));
}

// Whole for the cache, but of other arrays than a mesh's.
TEST(TetCache, EntriesOfAnotherKindAreMisses) {
    const TemporaryFolder folder;
    const DiskCache any(folder.path(), "tets");
    for (const std::string& content : {std::string(), std::string(24, '\xff'), std::string(32, '\0')}) {
        any.store(kKey, content);
        EXPECT_FALSE(TetCache(folder.path()).find(kKey)) << content.size() << " bytes";
    }
}

}  // namespace
}  // namespace gelatin
