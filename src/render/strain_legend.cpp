#include "render/strain_legend.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gelatin::render {
namespace {

constexpr int kMargin = 6, kBarHeight = 6, kGap = 2;
constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kAdvance = kGlyphWidth + 1;
constexpr int kHeightAPixel = 540;  // a legend's pixel is one more of the picture's for each so many rows

// Rows from the top, five bits each.
struct Glyph {
    char letter;
    std::array<std::uint8_t, kGlyphHeight> rows;
};
constexpr Glyph kGlyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},  {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {31, 2, 4, 2, 1, 17, 14}},     {'4', {2, 6, 10, 18, 31, 2, 2}}, {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},   {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 15, 1, 2, 12}},   {'-', {0, 0, 0, 31, 0, 0, 0}},   {'+', {0, 4, 4, 31, 4, 4, 0}},
    {'%', {24, 25, 2, 4, 8, 19, 3}},     {'.', {0, 0, 0, 0, 0, 12, 12}},  {'e', {0, 0, 14, 17, 31, 16, 14}},
};

glm::vec3 color_at(float place) {
    const auto& colors = strain_colors();
    const float at = place * static_cast<float>(colors.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(at), colors.size() - 2);
    return glm::mix(colors[stop], colors[stop + 1], at - static_cast<float>(stop));
}

// RGBA in [0, 1], rows from the bottom.
struct Canvas {
    int width, height;
    std::vector<glm::vec4> pixels;

    Canvas(int w, int h)
        : width(w),
          height(h),
          pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), glm::vec4(0.0f)) {}
    void set(int x, int y, const glm::vec4& color) {
        pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            color;
    }
    void write(std::string_view text, int x, int bottom) {
        for (const char letter : text) {
            const auto* glyph = std::find_if(std::begin(kGlyphs), std::end(kGlyphs),
                                             [&](const Glyph& g) { return g.letter == letter; });
            for (int i = 0; glyph != std::end(kGlyphs) && i < kGlyphWidth * kGlyphHeight; ++i) {
                const int column = i % kGlyphWidth, row = i / kGlyphWidth;
                if ((glyph->rows[static_cast<std::size_t>(row)] >> (kGlyphWidth - 1 - column) & 1) != 0)
                    set(x + column, bottom + kGlyphHeight - 1 - row, {0.1f, 0.12f, 0.16f, 1.0f});
            }
            x += kAdvance;
        }
    }
};

// "-10%    0    +10%" over the bar.
Canvas paint(float full_strain) {
    const std::string percent = fmt::format("{:.3g}%", 100.0 * static_cast<double>(full_strain));
    const std::string low = "-" + percent, high = "+" + percent;
    const int text_width = kAdvance * static_cast<int>(low.size()) - 1;
    const int bar_width = std::max(96, 2 * text_width + 4 * kAdvance);
    Canvas canvas(bar_width + 2 * kMargin, kMargin + kBarHeight + kGap + kGlyphHeight + kMargin);
    for (int y = 0; y < kBarHeight; ++y) {
        for (int x = 0; x < bar_width; ++x) {
            const float place = (static_cast<float>(x) + 0.5f) / static_cast<float>(bar_width);
            canvas.set(kMargin + x, kMargin + y, glm::vec4(color_at(place), 1.0f));
        }
    }
    const int text_bottom = kMargin + kBarHeight + kGap;
    canvas.write(low, kMargin, text_bottom);
    canvas.write("0", kMargin + (bar_width - kGlyphWidth) / 2, text_bottom);
    canvas.write(high, kMargin + bar_width - text_width, text_bottom);
    return canvas;
}

}  // namespace

const std::array<glm::vec3, 5>& strain_colors() {
    static const std::array<glm::vec3, 5> colors = {
        glm::vec3(0.03f, 0.19f, 0.62f), glm::vec3(0.30f, 0.60f, 0.93f), glm::vec3(0.93f, 0.93f, 0.90f),
        glm::vec3(0.98f, 0.60f, 0.18f), glm::vec3(0.80f, 0.16f, 0.02f)};
    return colors;
}

StrainLegend::StrainLegend(float full_strain)
    : full_strain_(full_strain), program_(gl::Program::graphics("render/legend.vert", "render/legend.frag")) {
    const Canvas canvas = paint(full_strain);
    picture_ = Target::color(canvas.width, canvas.height, GL_RGBA8);
    glActiveTexture(GL_TEXTURE7);
    glBindTexture(GL_TEXTURE_2D, picture_.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, canvas.width, canvas.height, GL_RGBA, GL_FLOAT,
                    canvas.pixels.data());
}

void StrainLegend::draw(const View& view) const {
    glActiveTexture(GL_TEXTURE7);
    glBindTexture(GL_TEXTURE_2D, picture_.texture());
    glBindSampler(7, 0);
    view.set_uniforms(program_);
    program_.set("enlargement", 1 + view.height / kHeightAPixel);
    program_.use();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace gelatin::render
