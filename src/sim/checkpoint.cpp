#include "sim/checkpoint.h"

#include <xxhash.h>

#include <cstring>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

// The file is this header, then the arrays of the state, one behind the other.
struct Header {
    char magic[8];
    std::uint32_t version;
    std::int32_t frame;
    double time;
    std::uint64_t nodes;
    std::uint64_t arrays;    // 2, or 3 with earlier velocities
    std::uint64_t topology;  // hash of what the nodes mean
    std::uint64_t checksum;  // hash of the arrays
};
static_assert(sizeof(Header) == 56);

constexpr char kMagic[8] = {'G', 'E', 'L', 'A', 'C', 'K', 'P', 'T'};
constexpr std::uint32_t kVersion = 2;

template <class T>
std::uint64_t hash(const std::vector<T>& values, std::uint64_t seed) {
    return XXH3_64bits_withSeed(values.data(), values.size() * sizeof(T), seed);
}

std::uint64_t topology_hash(const Model& model) {
    return hash(model.tets, hash(model.faces, model.positions.size()));
}

[[noreturn]] void refuse(const std::filesystem::path& file, const char* problem) {
    throw InvalidInput({file.string(), 0, {}, {}, problem});
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Model& model, const Checkpoint& checkpoint) {
    const State& state = checkpoint.state;
    std::string arrays;
    std::uint64_t count = 0;
    for (const std::vector<glm::vec4>* array :
         {&state.positions, &state.velocities, &state.earlier_velocities}) {
        if (array->empty()) continue;
        arrays.append(reinterpret_cast<const char*>(array->data()), array->size() * sizeof(glm::vec4));
        ++count;
    }
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.version = kVersion;
    header.frame = checkpoint.frame;
    header.time = checkpoint.time;
    header.nodes = state.positions.size();
    header.arrays = count;
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
    const std::size_t bytes = model.positions.size() * sizeof(glm::vec4);
    if (header.arrays < 2 || header.arrays > 3 || content.size() != sizeof(Header) + header.arrays * bytes)
        refuse(file, "is damaged: it has the wrong size");
    const char* next = content.data() + sizeof(Header);
    if (XXH3_64bits(next, header.arrays * bytes) != header.checksum)
        refuse(file, "is damaged: its checksum does not match");

    Checkpoint checkpoint;
    checkpoint.frame = header.frame;
    checkpoint.time = header.time;
    State& state = checkpoint.state;
    for (std::vector<glm::vec4>* array : {&state.positions, &state.velocities, &state.earlier_velocities}) {
        if (header.arrays == 2 && array == &state.earlier_velocities) break;
        array->resize(model.positions.size());
        std::memcpy(array->data(), next, bytes);
        next += bytes;
    }
    return checkpoint;
}

}  // namespace gelatin
