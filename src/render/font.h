#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/font_face.h"

namespace gelatin::render {

/// How much of each pixel a line of text covers: 0 none of it, 255 all; rows from the bottom, shape
/// [height][width].
struct TextPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> coverage;

    /// 0 outside.
    std::uint8_t at(int x, int y) const;
};

/// Letters for pictures, drawn by FreeType in DejaVu Sans, or in what the system has in its place. Where no
/// font is installed it warns once, and text is empty.
class Font {
public:
    /// @param size of the letters [pixels]: an em
    explicit Font(int size);

    int line_height() const { return line_height_; }  ///< [pixels]

    /// One line. @param text in UTF-8; what is not, and what the font lacks, is drawn as a box
    TextPicture paint(std::string_view text) const;

private:
    std::optional<FontFace> face_;
    int line_height_ = 0, descent_ = 0;
};

}  // namespace gelatin::render
