#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <string_view>

namespace gelatin {

/// The number whose bytes begin at `offset`, in this machine's byte order or the opposite one.
template <class T>
T load_bytes(std::string_view bytes, std::size_t offset, bool swapped) {
    assert(offset + sizeof(T) <= bytes.size());
    std::array<char, sizeof(T)> copy;
    std::memcpy(copy.data(), bytes.data() + offset, sizeof(T));
    if (swapped) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<T>(copy);
}

/// Whether little-endian numbers have to be swapped here.
constexpr bool kLittleIsSwapped = std::endian::native == std::endian::big;

}  // namespace gelatin
