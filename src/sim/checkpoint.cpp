#include "sim/checkpoint.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

// The file is this header, then the arrays of the state, those of the handles, the solver's memory and what
// programs have set, one after the other.
struct Header {
    char magic[8];
    std::uint32_t version;
    std::int32_t frame;
    double time;
    std::uint64_t nodes;
    std::uint64_t arrays;      // 2, or 3 with earlier velocities
    std::uint64_t handles;     // in the arrays of drags and delays; 0 if nothing is dragged or late
    std::uint64_t topology;    // hash of the model's topology
    std::uint64_t memory;      // bytes of the solver's memory
    std::uint64_t programmed;  // bytes of Checkpoint::programmed
    std::uint64_t checksum;    // hash of all that follows
};
static_assert(sizeof(Header) == 80 && sizeof(Drag) == 56);

constexpr char kMagic[8] = {'G', 'E', 'L', 'A', 'C', 'K', 'P', 'T'};
constexpr std::uint32_t kVersion = 7;

template <class T>
std::uint64_t hash(const std::vector<T>& values, std::uint64_t seed) {
    return XXH3_64bits_withSeed(values.data(), values.size() * sizeof(T), seed);
}

// Whether a handle is anywhere but where its keyframes have it.
bool is_any_away(const Checkpoint& checkpoint) {
    const auto is_away = [](const Drag& drag) { return drag != Drag(); };
    const auto is_late = [](double delay) { return delay != 0.0; };
    return std::any_of(checkpoint.drags.begin(), checkpoint.drags.end(), is_away) ||
           std::any_of(checkpoint.drag_targets.begin(), checkpoint.drag_targets.end(), is_away) ||
           std::any_of(checkpoint.delays.begin(), checkpoint.delays.end(), is_late);
}

// One value for each handle, also where the checkpoint has none.
template <class T>
std::vector<T> for_handles(std::vector<T> values, std::size_t handles) {
    values.resize(handles);
    return values;
}

template <class T>
void append(const std::vector<T>& array, std::string& bytes) {
    bytes.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T));
}

template <class T>
void take(const char*& next, std::size_t count, std::vector<T>& array) {
    array.resize(count);
    std::copy_n(next, count * sizeof(T),
                reinterpret_cast<char*>(array.data()));  // none: no array has that many
    next += count * sizeof(T);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* problem) {
    throw InvalidInput({file.string(), 0, {}, {}, problem});
}

}  // namespace

std::uint64_t topology_hash(const Model& model) {
    return hash(model.tets, hash(model.faces, model.positions.size()));
}

void write_checkpoint(const std::filesystem::path& file, const Model& model, const Checkpoint& checkpoint) {
    const State& state = checkpoint.state;
    std::string arrays;
    std::uint64_t count = 0;
    for (const std::vector<glm::vec4>* array :
         {&state.positions, &state.velocities, &state.earlier_velocities}) {
        if (array->empty()) continue;
        append(*array, arrays);
        ++count;
    }
    const std::size_t handles =
        is_any_away(checkpoint)
            ? std::max({checkpoint.drags.size(), checkpoint.drag_targets.size(), checkpoint.delays.size()})
            : 0;
    if (handles > 0) {
        append(for_handles(checkpoint.drags, handles), arrays);
        append(for_handles(checkpoint.drag_targets, handles), arrays);
        append(for_handles(checkpoint.delays, handles), arrays);
    }
    arrays += state.memory + checkpoint.programmed;
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.version = kVersion;
    header.frame = checkpoint.frame;
    header.time = checkpoint.time;
    header.nodes = state.positions.size();
    header.arrays = count;
    header.handles = handles;
    header.memory = state.memory.size();
    header.programmed = checkpoint.programmed.size();
    header.topology = topology_hash(model);
    header.checksum = XXH3_64bits(arrays.data(), arrays.size());

    std::string content(sizeof(Header), '\0');
    std::memcpy(content.data(), &header, sizeof(Header));
    write_file(file, content + arrays);
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const Model& model) {
    const std::string content = read_file(file);
    Header header{};
    if (content.size() < sizeof(Header)) refuse(file, "is not a Gelatin checkpoint");
    std::memcpy(&header, content.data(), sizeof(Header));
    if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0) refuse(file, "is not a Gelatin checkpoint");
    if (header.version != kVersion) refuse(file, "was written by another version of Gelatin");
    if (header.nodes != model.positions.size() || header.topology != topology_hash(model)) {
        refuse(file, "was made from a scene with other objects or meshes");
    }
    if (header.handles != 0 && header.handles != model.handles.size())
        refuse(file, "was made from a scene with other pins or handles");
    const std::size_t bytes = header.arrays * model.positions.size() * sizeof(glm::vec4) +
                              header.handles * (2 * sizeof(Drag) + sizeof(double)) + header.memory +
                              header.programmed;
    if (header.arrays < 2 || header.arrays > 3 || content.size() != sizeof(Header) + bytes)
        refuse(file, "is damaged: it has the wrong size");
    const char* next = content.data() + sizeof(Header);
    if (XXH3_64bits(next, bytes) != header.checksum) refuse(file, "is damaged: its checksum does not match");

    Checkpoint checkpoint;
    checkpoint.frame = header.frame;
    checkpoint.time = header.time;
    State& state = checkpoint.state;
    take(next, model.positions.size(), state.positions);
    take(next, model.positions.size(), state.velocities);
    if (header.arrays == 3) take(next, model.positions.size(), state.earlier_velocities);
    take(next, header.handles, checkpoint.drags);
    take(next, header.handles, checkpoint.drag_targets);
    take(next, header.handles, checkpoint.delays);
    state.memory.assign(next, header.memory);
    checkpoint.programmed.assign(next + header.memory, header.programmed);
    checkpoint.drags.resize(model.handles.size());
    checkpoint.drag_targets.resize(model.handles.size());
    checkpoint.delays.resize(model.handles.size());
    return checkpoint;
}

}  // namespace gelatin
