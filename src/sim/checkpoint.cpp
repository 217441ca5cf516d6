#include "sim/checkpoint.h"

#include <xxhash.h>

#include <cstring>
#include <string>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin {
namespace {

// The file is this header, then the positions and the velocities.
struct Header {
    char magic[8];
    std::uint32_t version;
    std::int32_t frame;
    double time;
    std::uint64_t nodes;
    std::uint64_t topology;  // hash of what the nodes mean
    std::uint64_t checksum;  // hash of positions and velocities
};
static_assert(sizeof(Header) == 48);

constexpr char kMagic[8] = {'G', 'E', 'L', 'A', 'C', 'K', 'P', 'T'};
constexpr std::uint32_t kVersion = 1;

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
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.version = kVersion;
    header.frame = checkpoint.frame;
    header.time = checkpoint.time;
    header.nodes = state.positions.size();
    header.topology = topology_hash(model);
    header.checksum = hash(state.velocities, hash(state.positions, 0));

    const std::size_t bytes = state.positions.size() * sizeof(glm::vec4);
    std::string content(sizeof(Header) + 2 * bytes, '\0');
    std::memcpy(content.data(), &header, sizeof(Header));
    std::memcpy(content.data() + sizeof(Header), state.positions.data(), bytes);
    std::memcpy(content.data() + sizeof(Header) + bytes, state.velocities.data(), bytes);
    write_file(file, content);
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
    if (content.size() != sizeof(Header) + 2 * bytes) refuse(file, "is damaged: it has the wrong size");

    Checkpoint checkpoint;
    checkpoint.frame = header.frame;
    checkpoint.time = header.time;
    checkpoint.state.positions.resize(model.positions.size());
    checkpoint.state.velocities.resize(model.positions.size());
    std::memcpy(checkpoint.state.positions.data(), content.data() + sizeof(Header), bytes);
    std::memcpy(checkpoint.state.velocities.data(), content.data() + sizeof(Header) + bytes, bytes);
    if (hash(checkpoint.state.velocities, hash(checkpoint.state.positions, 0)) != header.checksum) {
        refuse(file, "is damaged: its checksum does not match");
    }
    return checkpoint;
}

}  // namespace gelatin
