#pragma once

#include <array>
#include <cstdint>

namespace gelatin::render {

/// Letters of five by seven pixels, for pictures that look the same on every machine, whatever fonts it has.
constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kGlyphAdvance = kGlyphWidth + 1;

/// Rows from the top, five bits each, the leftmost being 16. A question mark for what is not among letters,
/// digits and common signs of ASCII.
const std::array<std::uint8_t, kGlyphHeight>& glyph_of(char letter);

}  // namespace gelatin::render
