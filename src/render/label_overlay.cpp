#include "render/label_overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/vec4.hpp>
#include <span>

#include "render/pixel_font.h"

namespace gelatin::render {
namespace {

constexpr char kFirst = ' ', kLast = '~';
constexpr int kGlyphs = kLast - kFirst + 1;
// With a pixel all round; as in shaders/render/labels.vert.
constexpr int kCellWidth = kGlyphWidth + 2, kCellHeight = kGlyphHeight + 2;

bool is_ink(char letter, int x, int y) {  // from the lower left corner
    if (x < 0 || y < 0 || x >= kGlyphWidth || y >= kGlyphHeight) return false;
    const auto row = static_cast<std::size_t>(kGlyphHeight - 1 - y);
    return (glyph_of(letter)[row] >> (kGlyphWidth - 1 - x) & 1) != 0;
}

bool is_beside_ink(char letter, int x, int y) {
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            if (is_ink(letter, x + i, y + j)) return true;
        }
    }
    return false;
}

Target paint_font() {
    constexpr int kWidth = kGlyphs * kCellWidth;
    std::vector<glm::vec4> pixels;
    for (int y = 0; y < kCellHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const auto letter = static_cast<char>(kFirst + x / kCellWidth);
            const int column = x % kCellWidth - 1, row = y - 1;
            pixels.emplace_back(is_ink(letter, column, row), is_beside_ink(letter, column, row), 0.0f, 1.0f);
        }
    }
    glActiveTexture(GL_TEXTURE7);
    Target font = Target::color(kWidth, kCellHeight, GL_RGBA8);
    glBindTexture(GL_TEXTURE_2D, font.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kWidth, kCellHeight, GL_RGBA, GL_FLOAT, pixels.data());
    return font;
}

// Object; glyph in the lower 16 bits, and above them where it stands from the label's left end, and how long
// that is, each in letters of up to 255.
std::vector<glm::uvec2> list_letters(std::span<const std::string> names) {
    std::vector<glm::uvec2> letters;
    for (std::size_t o = 0; o < names.size(); ++o) {
        const std::string name = names[o].substr(0, 255);
        for (std::size_t i = 0; i < name.size(); ++i) {
            const char letter = name[i] >= kFirst && name[i] <= kLast ? name[i] : '?';
            letters.emplace_back(o,
                                 static_cast<std::uint32_t>(letter - kFirst) | i << 16 | name.size() << 24);
        }
    }
    return letters;
}

}  // namespace

LabelOverlay::LabelOverlay()
    : program_(gl::Program::graphics("render/labels.vert", "render/labels.frag")), font_(paint_font()) {}

void LabelOverlay::show(const ObjectView& objects) {
    if (std::ranges::equal(objects.names, names_)) return;
    names_.assign(objects.names.begin(), objects.names.end());
    letters_ = gl::Buffer<glm::uvec2>(std::span<const glm::uvec2>(list_letters(names_)));
}

void LabelOverlay::draw(const View& view, const OverlayView& overlay) const {
    if (letters_.empty()) return;
    const gl::BufferTexture boxes(overlay.boxes, std::size_t{32} * overlay.box_count,
                                  gl::TexelFormat::rgba32f);
    const gl::BufferTexture roots(overlay.objects->roots, std::size_t{4} * names_.size(),
                                  gl::TexelFormat::r32ui);
    const gl::BufferTexture letters(letters_, gl::TexelFormat::rg32ui);
    boxes.bind(0);
    roots.bind(1);
    letters.bind(2);
    glActiveTexture(GL_TEXTURE7);
    glBindTexture(GL_TEXTURE_2D, font_.texture());
    glBindSampler(7, 0);
    view.set_uniforms(program_);
    program_.set("enlargement", view.letter_scale());
    program_.use();
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * letters_.size()));
}

}  // namespace gelatin::render
