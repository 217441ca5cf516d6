#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace gelatin {

// Floats as what a prediction leaves of them: no bit is lost, and the same prediction gives the same bits
// back. Good predictions leave small numbers.

namespace detail {

// Whole numbers in the order of the floats, so that near floats have near numbers.
inline std::uint32_t ordered(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
inline float from_ordered(std::uint32_t number) {
    return std::bit_cast<float>((number & 0x80000000u) != 0 ? number & 0x7FFFFFFFu : ~number);
}

// Small numbers of either sign as small ones: 0, -1, 1, -2, 2 as 0, 1, 2, 3, 4.
inline std::uint32_t folded(std::uint32_t difference) {
    return (difference << 1) ^ (0u - (difference >> 31));
}
inline std::uint32_t unfolded(std::uint32_t number) {
    return (number >> 1) ^ (0u - (number & 1u));
}

}  // namespace detail

inline std::uint32_t residual(float value, float predicted) {
    return detail::folded(detail::ordered(value) - detail::ordered(predicted));
}
inline float with_residual(float predicted, std::uint32_t residual) {
    return detail::from_ordered(detail::ordered(predicted) + detail::unfolded(residual));
}

/// Appends numbers as bytes: all lowest ones, then all second ones and so on, so that a compressor finds
/// like ones beside each other. Before them is a byte that says which of these four are not all zero; the
/// others are left out.
void append_planes(std::span<const std::uint32_t> numbers, std::string& bytes);

/// @param bytes that begin as append_planes has made them of so many numbers; output: what follows
/// @return false if there are too few
bool read_planes(std::string_view& bytes, std::span<std::uint32_t> numbers);

}  // namespace gelatin
