#include "mesh/vtu_bytes.h"

#include <fmt/core.h>
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "gelatin/error.h"
#include "mesh/load_bytes.h"

namespace gelatin {
namespace {

constexpr const char* kCutOff = "is cut off";

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// Bytes, read in order. Base64 may end with padding and go on: VTK codes the header of compressed arrays
/// apart.
class ByteSource {
public:
    ByteSource(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

    /// @throws InvalidInput if there are fewer.
    std::string take(std::uint64_t size) {
        if (size > most_left()) throw InvalidInput(kCutOff);
        if (!is_base64_) {
            std::string bytes(text_.substr(0, size));
            text_.remove_prefix(size);
            return bytes;
        }
        while (decoded_.size() < size) decode_four();
        std::string bytes = decoded_.substr(0, size);
        decoded_.erase(0, size);
        return bytes;
    }

    /// An upper limit of the number of bytes left.
    std::uint64_t most_left() const {
        return is_base64_ ? decoded_.size() + text_.size() / 4 * 3 : text_.size();
    }

private:
    void decode_four() {
        std::uint32_t bits = 0;
        int digits = 0, paddings = 0;
        while (digits + paddings < 4) {
            if (text_.empty()) throw InvalidInput(kCutOff);
            const char c = text_.front();
            text_.remove_prefix(1);
            if (is_space(c)) continue;
            const int digit = base64_digit(c);
            const bool is_padding = c == '=' && digits >= 2;
            if (!is_padding && (digit < 0 || paddings > 0)) throw InvalidInput("is not valid base64");
            bits = bits << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
            ++(is_padding ? paddings : digits);
        }
        for (int k = 0; k < 3 - paddings; ++k) decoded_ += static_cast<char>(bits >> (16 - 8 * k) & 255);
    }

    std::string_view text_;
    bool is_base64_;
    std::string decoded_;  // but not taken yet
};

/// Reads one array. @throws InvalidInput
class ArrayDecoder {
public:
    ArrayDecoder(std::string_view text, const VtuCoding& coding)
        : source_(text, coding.is_base64), coding_(coding) {}

    std::string decode() {
        if (!coding_.is_compressed) return source_.take(header_number());
        const std::uint64_t blocks = header_number(), block_size = header_number(),
                            last_size = header_number();
        if (blocks > source_.most_left() / coding_.header_size) throw InvalidInput(kCutOff);
        std::vector<std::uint64_t> packed_sizes;
        for (std::uint64_t b = 0; b < blocks; ++b) packed_sizes.push_back(header_number());
        std::string bytes;
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const bool is_partial = b + 1 == blocks && last_size > 0;
            bytes += inflate_block(packed_sizes[b], is_partial ? last_size : block_size);
        }
        return bytes;
    }

private:
    std::uint64_t header_number() {
        const std::string bytes = source_.take(coding_.header_size);
        return coding_.header_size == 4 ? load_bytes<std::uint32_t>(bytes, 0, coding_.is_swapped)
                                        : load_bytes<std::uint64_t>(bytes, 0, coding_.is_swapped);
    }

    std::string inflate_block(std::uint64_t packed_size, std::uint64_t size) {
        constexpr std::uint64_t kMostRatio = 1040;  // zlib's technical details: 1032 to 1
        const std::string packed = source_.take(packed_size);
        if (size > kMostRatio * (packed_size + 1))
            throw InvalidInput(
                fmt::format("has a block of {} bytes of which zlib cannot make {}", packed_size, size));
        std::string bytes(size, '\0');
        uLongf length = size;
        const int result = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                                        reinterpret_cast<const Bytef*>(packed.data()), packed.size());
        if (result != Z_OK || length != size)
            throw InvalidInput(fmt::format("has a block that zlib cannot make {} bytes of", size));
        return bytes;
    }

    ByteSource source_;
    const VtuCoding& coding_;
};

}  // namespace

std::string decode_vtu_bytes(std::string_view text, const VtuCoding& coding) {
    return ArrayDecoder(text, coding).decode();
}

}  // namespace gelatin
