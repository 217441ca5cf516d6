#include "core/utf8.h"

namespace gelatin {

std::optional<char32_t> next_code_point(std::string_view text, std::size_t& at) {
    const std::size_t begin = at++;
    const auto first = static_cast<unsigned char>(text[begin]);
    const int more = first < 0x80   ? 0
                     : first < 0xc0 ? -1
                     : first < 0xe0 ? 1
                     : first < 0xf0 ? 2
                     : first < 0xf8 ? 3
                                    : -1;
    if (more < 0 || begin + static_cast<std::size_t>(more) >= text.size()) return std::nullopt;
    char32_t letter = more == 0 ? first : first & (0x3fu >> more);
    for (int m = 1; m <= more; ++m) {
        const auto next = static_cast<unsigned char>(text[begin + static_cast<std::size_t>(m)]);
        if ((next & 0xc0) != 0x80) return std::nullopt;
        letter = letter << 6 | (next & 0x3fu);
    }
    constexpr char32_t kSmallest[] = {0, 0x80, 0x800, 0x10000};
    if (letter < kSmallest[more] || letter > 0x10ffff || (letter >= 0xd800 && letter <= 0xdfff))
        return std::nullopt;
    at = begin + 1 + static_cast<std::size_t>(more);
    return letter;
}

}  // namespace gelatin
