#include "render/font.h"

#include <algorithm>

#include "core/log.h"
#include "core/utf8.h"
#include "gelatin/error.h"

namespace gelatin::render {
namespace {

constexpr char32_t kReplacement = 0xfffd;

// Of FreeType's lengths, which are in 1/64 pixel.
int round_up(FT_Pos length) {
    return static_cast<int>((length + 63) / 64);
}

std::optional<FontFace> open_face() {
    static bool has_warned = false;
    for (const char* font : {"DejaVu Sans", "sans"}) {
        try {
            return FontFace(font);
        } catch (const InvalidInput&) {  // the next one, then
        }
    }
    if (!has_warned) spdlog::warn("no font is installed: pictures have no text");
    has_warned = true;
    return std::nullopt;
}

struct Glyph {
    FT_UInt index;
    int x;  // of its origin [pixels]
};

// Where the glyphs of a line stand, and its width.
struct Line {
    std::vector<Glyph> glyphs;
    int width = 0;
};

Line set_line(FT_Face face, std::string_view text) {
    Line line;
    for (std::size_t at = 0; at < text.size();) {
        const char32_t letter = next_code_point(text, at).value_or(kReplacement);
        const FT_UInt index = FT_Get_Char_Index(face, letter);
        if (FT_Load_Glyph(face, index, FT_LOAD_TARGET_LIGHT) != 0) continue;
        line.glyphs.push_back({index, line.width});
        line.width += round_up(face->glyph->advance.x);
    }
    return line;
}

}  // namespace

std::uint8_t TextPicture::at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
}

Font::Font(int size) : face_(open_face()) {
    if (!face_) return;
    FT_Set_Pixel_Sizes(face_->get(), 0, static_cast<FT_UInt>(size));
    const FT_Size_Metrics& metrics = face_->get()->size->metrics;
    descent_ = round_up(-metrics.descender);
    line_height_ = round_up(metrics.ascender) + descent_;
}

TextPicture Font::paint(std::string_view text) const {
    if (!face_) return {};
    FT_Face face = face_->get();
    const Line line = set_line(face, text);
    TextPicture picture{line.width, line_height_, {}};
    picture.coverage.resize(static_cast<std::size_t>(line.width) * static_cast<std::size_t>(line_height_));
    for (const Glyph& glyph : line.glyphs) {
        if (FT_Load_Glyph(face, glyph.index, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
        const FT_GlyphSlot slot = face->glyph;
        const FT_Bitmap& bitmap = slot->bitmap;
        for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
            const int y = descent_ + slot->bitmap_top - 1 - row;
            for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
                const int x = glyph.x + slot->bitmap_left + column;
                if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
                std::uint8_t& pixel =
                    picture.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                     static_cast<std::size_t>(x)];
                pixel = std::max(pixel, bitmap.buffer[row * bitmap.pitch + column]);
            }
        }
    }
    return picture;
}

}  // namespace gelatin::render
