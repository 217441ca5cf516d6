#include "sim/recording/residuals.h"

namespace gelatin {

void append_planes(std::span<const std::uint32_t> numbers, std::string& bytes) {
    const std::size_t count = numbers.size();
    std::size_t next = bytes.size();
    bytes.resize(next + sizeof(std::uint32_t) * count);
    for (unsigned plane = 0; plane < sizeof(std::uint32_t); ++plane)
        for (std::size_t k = 0; k < count; ++k) bytes[next++] = static_cast<char>(numbers[k] >> (8 * plane));
}

void read_planes(std::string_view bytes, std::span<std::uint32_t> numbers) {
    const std::size_t count = numbers.size();
    for (std::size_t k = 0; k < count; ++k) {
        numbers[k] = 0;
        for (unsigned plane = 0; plane < sizeof(std::uint32_t); ++plane)
            numbers[k] |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[plane * count + k]))
                          << (8 * plane);
    }
}

}  // namespace gelatin
