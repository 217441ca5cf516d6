#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace gelatin {

/// The code point of UTF-8 `text` that begins at byte `at`, and moves `at` to the byte behind it.
/// @return nothing, and `at` one byte further, where the bytes are not UTF-8 (overlong forms and surrogates
/// are not)
/// @pre at < text.size()
std::optional<char32_t> next_code_point(std::string_view text, std::size_t& at);

}  // namespace gelatin
