#include "mesh/tet_cache.h"

#include <sstream>
#include <utility>
#include <vector>

#include "core/packed_arrays.h"

namespace gelatin {

namespace {

constexpr char kWarning = '\1';  // in front of a note

}  // namespace

static_assert(sizeof(glm::dvec3) == 24 && sizeof(glm::uvec4) == 16 && sizeof(glm::uvec3) == 12);

TetCache::TetCache(std::filesystem::path folder)
    : cache_(folder, "tets"), failures_(std::move(folder), "failure") {}

std::optional<CachedTets> TetCache::find(const std::string& key) const {
    const std::optional<std::string> bytes = cache_.find(key);
    if (!bytes) return std::nullopt;
    ArrayReader reader(*bytes);
    CachedTets tets;
    TetMesh& mesh = tets.mesh;
    std::vector<char> notes;
    const bool is_whole = reader.take(mesh.positions) && reader.take(mesh.tets) && reader.take(mesh.faces) &&
                          reader.take(mesh.attributes) && reader.take(notes);
    if (!is_whole || !reader.at_end()) return std::nullopt;
    std::istringstream lines(std::string(notes.begin(), notes.end()));
    for (std::string line; std::getline(lines, line);) {
        const bool is_warning = line.starts_with(kWarning);
        tets.notes.emplace_back(line.substr(is_warning ? 1 : 0), is_warning);
    }
    return tets;
}

void TetCache::store(const std::string& key, const CachedTets& tets) const {
    std::vector<char> notes;
    for (const Note& note : tets.notes) {
        if (note.is_warning) notes.push_back(kWarning);
        notes.insert(notes.end(), note.text.begin(), note.text.end());
        notes.push_back('\n');
    }
    ArrayWriter writer;
    writer.add(tets.mesh.positions);
    writer.add(tets.mesh.tets);
    writer.add(tets.mesh.faces);
    writer.add(tets.mesh.attributes);
    writer.add(notes);
    cache_.store(key, writer.bytes());
}

std::optional<MesherFailure> TetCache::find_failure(const std::string& key) const {
    const std::optional<std::string> bytes = failures_.find(key);
    if (!bytes) return std::nullopt;
    ArrayReader reader(*bytes);
    std::vector<char> field, value, problem;
    std::vector<double> limit;
    const bool is_whole =
        reader.take(field) && reader.take(value) && reader.take(problem) && reader.take(limit);
    if (!is_whole || !reader.at_end() || limit.size() != 1) return std::nullopt;
    const auto text = [](const std::vector<char>& letters) {
        return std::string(letters.begin(), letters.end());
    };
    return MesherFailure{text(field), text(value), text(problem), limit.front()};
}

void TetCache::store_failure(const std::string& key, const MesherFailure& failure) const {
    ArrayWriter writer;
    for (const std::string* text : {&failure.field, &failure.value, &failure.problem})
        writer.add(std::vector<char>(text->begin(), text->end()));
    writer.add(std::vector<double>{failure.retry_above});
    failures_.store(key, writer.bytes());
}

}  // namespace gelatin
