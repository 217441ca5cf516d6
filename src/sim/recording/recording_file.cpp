#include "sim/recording/recording_file.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/file_writer.h"
#include "gelatin/error.h"
#include "gelatin/version.h"

namespace gelatin {
namespace {

constexpr char kMagic[8] = {'G', 'E', 'L', 'A', 'T', 'R', 'E', 'C'};
constexpr std::uint32_t kVersion = 4, kFrameMark = 0x4D415246u;  // "FRAM"

// The file begins with this, followed by JSON text and the meshes' bytes.
struct FileHeader {
    char magic[8];
    std::uint32_t version;
    std::uint32_t reserved;
    std::uint64_t text_size, meshes_size;
    std::uint64_t checksum;  // of both
};
static_assert(sizeof(FileHeader) == 40);

// Each frame begins with this, followed by its bytes.
struct FrameHeader {
    std::uint32_t mark;
    std::uint32_t is_key;
    std::int32_t frame;
    std::uint32_t reserved;
    double time;
    std::uint64_t size, checksum;  // of the bytes
    std::uint64_t own_checksum;    // of this header before it
};
static_assert(sizeof(FrameHeader) == 48);

std::uint64_t hash(const std::string& bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}
std::uint64_t own_checksum(const FrameHeader& header) {
    return XXH3_64bits(&header, offsetof(FrameHeader, own_checksum));
}

template <class Header>
std::string bytes_of(const Header& header) {
    return {reinterpret_cast<const char*>(&header), sizeof(header)};
}

template <class Header>
bool take(std::istream& stream, Header& header) {
    return static_cast<bool>(stream.read(reinterpret_cast<char*>(&header), sizeof(header)));
}

}  // namespace

RecordingOutput::RecordingOutput(std::filesystem::path file, const RecordingHead& head)
    : file_(std::move(file)), stream_(file_, std::ios::binary | std::ios::trunc) {
    if (!stream_) fail_to_write(file_, errno);
    const std::string text = nlohmann::json{
        {"gelatin", {{"version", version()}, {"commit", commit()}}},
        {"scene", head.scene.text},
        {"scene_file", head.scene.file.string()},
        {"topology",
         head.topology}}.dump();
    FileHeader header{};
    std::memcpy(header.magic, kMagic, sizeof(kMagic));
    header.version = kVersion;
    header.text_size = text.size();
    header.meshes_size = head.scene.meshes.size();
    const std::string content = text + head.scene.meshes;
    header.checksum = hash(content);
    write(bytes_of(header) + content);
}

void RecordingOutput::append(RecordingEntry entry, const std::string& bytes) {
    FrameHeader header{kFrameMark, entry.is_key ? 1u : 0u, entry.frame, 0,
                       entry.time, bytes.size(),           hash(bytes), 0};
    header.own_checksum = own_checksum(header);
    write(bytes_of(header) + bytes);
}

// Through to the system, which keeps it even if this process is killed.
void RecordingOutput::write(const std::string& bytes) {
    errno = 0;
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream_.flush();
    if (!stream_) fail_to_write(file_, errno);
}

RecordingInput::RecordingInput(std::filesystem::path file)
    : file_(std::move(file)), stream_(file_, std::ios::binary) {
    std::error_code error;
    if (!std::filesystem::exists(file_, error)) refuse("no such file");
    FileHeader header{};
    if (!stream_ || !take(stream_, header) || std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
        refuse("is not a recording of Gelatin");
    if (header.version != kVersion)
        refuse(fmt::format("was written by another version of Gelatin: its format is {}, not {}",
                           header.version, kVersion));
    const std::uint64_t left = std::filesystem::file_size(file_, error) - sizeof(header);
    if (header.text_size > left || header.meshes_size > left - header.text_size)
        refuse("is cut off before its first frame");
    std::string content(header.text_size + header.meshes_size, '\0');
    stream_.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (!stream_) refuse("is cut off before its first frame");
    if (hash(content) != header.checksum) refuse("is damaged: its checksum does not match");
    take_head(content.substr(0, header.text_size));
    head_.scene.meshes = content.substr(header.text_size);
    find_entries(sizeof(header) + content.size());
    if (entries_.empty()) refuse("has no complete frame");
    if (!entries_.front().is_key) refuse("is damaged: its first frame is predicted from another one");
}

void RecordingInput::take_head(const std::string& text) {
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) refuse("is damaged");
    try {
        head_.scene.text = json.value("scene", "");
        head_.scene.file = json.value("scene_file", "");
        head_.topology = json.value("topology", std::uint64_t(0));
    } catch (const nlohmann::json::exception&) {
        refuse("is damaged");
    }
}

void RecordingInput::find_entries(std::uint64_t offset) {
    const std::uint64_t end = std::filesystem::file_size(file_);
    while (offset < end) {
        FrameHeader header{};
        stream_.seekg(static_cast<std::streamoff>(offset));
        is_cut_off_ = !take(stream_, header) || header.mark != kFrameMark ||
                      header.own_checksum != own_checksum(header) ||
                      header.size > end - offset - sizeof(header);
        if (is_cut_off_) break;
        offset += sizeof(header);
        entries_.push_back(
            {header.frame, header.is_key != 0, header.time, offset, header.size, header.checksum});
        offset += header.size;
    }
    stream_.clear();
}

std::string RecordingInput::read(const RecordingEntry& entry) const {
    std::string bytes(entry.size, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(entry.offset));
    stream_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream_ || hash(bytes) != entry.checksum)
        refuse(fmt::format("is damaged: the checksum of frame {} does not match", entry.frame));
    return bytes;
}

void RecordingInput::refuse(const std::string& problem) const {
    throw InvalidInput({file_.string(), 0, {}, {}, problem});
}

}  // namespace gelatin
