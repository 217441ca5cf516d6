#include "sim/recording/residuals.h"

#include <algorithm>

namespace gelatin {
namespace {

constexpr unsigned kPlanes = sizeof(std::uint32_t), kBits = 8;

}  // namespace

void append_planes(std::span<const std::uint32_t> numbers, std::string& bytes) {
    std::uint32_t all = 0;  // bits of any number
    for (const std::uint32_t number : numbers) all |= number;
    const std::size_t mask_at = bytes.size();
    bytes += '\0';
    for (unsigned plane = 0; plane < kPlanes; ++plane) {
        if ((all >> (kBits * plane) & 0xFFu) == 0) continue;
        bytes[mask_at] = static_cast<char>(bytes[mask_at] | 1 << plane);
        const std::size_t first = bytes.size();
        bytes.resize(first + numbers.size());
        char* const to = bytes.data() + first;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            to[k] = static_cast<char>(numbers[k] >> (kBits * plane));
    }
}

bool read_planes(std::string_view& bytes, std::span<std::uint32_t> numbers) {
    std::fill(numbers.begin(), numbers.end(), 0u);
    if (bytes.empty()) return false;
    const auto mask = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    for (unsigned plane = 0; plane < kPlanes; ++plane) {
        if ((mask >> plane & 1) == 0) continue;
        if (bytes.size() < numbers.size()) return false;
        for (std::size_t k = 0; k < numbers.size(); ++k)
            numbers[k] |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) << (kBits * plane);
        bytes.remove_prefix(numbers.size());
    }
    return true;
}

}  // namespace gelatin
