#include "render/legend.h"

#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "render/font.h"
#include "render/palette.h"

namespace gelatin::render {
namespace {

constexpr int kLeastBarWidth = 12;  // [em]
const glm::vec4 kInk(0.1f, 0.12f, 0.16f, 1.0f);
const glm::vec4 kPlate(1.0f, 1.0f, 1.0f, 0.55f);  // so that numbers are legible on any background

glm::vec3 color_at(std::span<const glm::vec3> colors, float place) {
    const float at = place * static_cast<float>(colors.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(at), colors.size() - 2);
    return glm::mix(colors[stop], colors[stop + 1], at - static_cast<float>(stop));
}

// RGBA in [0, 1], rows from the bottom.
struct Canvas {
    int width, height;
    std::vector<glm::vec4> pixels;

    Canvas(int w, int h)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), kPlate) {}
    glm::vec4& pixel(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    void write(const TextPicture& text, int left, int bottom) {
        for (int y = 0; y < text.height; ++y) {
            for (int x = 0; x < text.width; ++x) {
                const float covered = static_cast<float>(text.at(x, y)) / 255.0f;
                glm::vec4& under = pixel(left + x, bottom + y);
                under = glm::mix(under, kInk, covered);
            }
        }
    }
};

// The title above the numbers above the bar.
Canvas paint(const ColorScale& scale, int letter_size) {
    const Font font(letter_size);
    const TextPicture low = font.paint(scale.low), middle = font.paint(scale.middle),
                      high = font.paint(scale.high), title = font.paint(scale.title);
    const int margin = letter_size / 2, gap = letter_size / 4, bar_height = letter_size / 2;
    const int ends = std::max(low.width, high.width);
    const int numbers = 2 * ends + middle.width + 2 * letter_size;
    const int bar_width = std::max({kLeastBarWidth * letter_size, numbers, title.width});
    const int line = gap + font.line_height();
    Canvas canvas(bar_width + 2 * margin, 2 * margin + bar_height + line + (scale.title.empty() ? 0 : line));
    for (int y = 0; y < bar_height; ++y) {
        for (int x = 0; x < bar_width; ++x) {
            const float place = (static_cast<float>(x) + 0.5f) / static_cast<float>(bar_width);
            canvas.pixel(margin + x, margin + y) = glm::vec4(color_at(scale.colors, place), 1.0f);
        }
    }
    const int bottom = margin + bar_height + gap;
    canvas.write(low, margin, bottom);
    canvas.write(middle, margin + (bar_width - middle.width) / 2, bottom);
    canvas.write(high, margin + bar_width - high.width, bottom);
    canvas.write(title, margin, bottom + line);
    return canvas;
}

glm::vec3 from_hex(unsigned color) {
    return glm::vec3(color >> 16 & 255u, color >> 8 & 255u, color & 255u) / 255.0f;
}

struct Unit {
    const char* name;
    float size;
};

// So that numbers are from 1 to 999 if there is such a unit.
Unit unit_of(Quantity quantity, float full) {
    if (quantity == Quantity::stretch) return {"", 1.0f};
    if (quantity == Quantity::speed) return full < 1.0f ? Unit{" mm/s", 1e-3f} : Unit{" m/s", 1.0f};
    if (full >= 1e9f) return {" GPa", 1e9f};
    if (full >= 1e6f) return {" MPa", 1e6f};
    return full >= 1e3f ? Unit{" kPa", 1e3f} : Unit{" Pa", 1.0f};
}

const char* title_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::stretch:
            return "largest stretch";
        case Quantity::stress:
            return "von Mises stress";
        case Quantity::pressure:
            return "contact pressure";
        case Quantity::speed:
            break;
    }
    return "speed";
}

void set_colors(const gl::Program& program, const std::string& name, std::span<const glm::vec3> colors) {
    for (std::size_t i = 0; i < colors.size(); ++i)
        program.set(name + "[" + std::to_string(i) + "]", colors[i]);
}

}  // namespace

const std::array<glm::vec3, 5>& strain_colors() {
    static const std::array<glm::vec3, 5> colors = {
        glm::vec3(0.03f, 0.19f, 0.62f), glm::vec3(0.30f, 0.60f, 0.93f), glm::vec3(0.93f, 0.93f, 0.90f),
        glm::vec3(0.98f, 0.60f, 0.18f), glm::vec3(0.80f, 0.16f, 0.02f)};
    return colors;
}

ColorScale strain_scale(float full_strain) {
    const std::string percent = fmt::format("{:.3g}%", 100.0 * static_cast<double>(full_strain));
    return {strain_colors(), "", "-" + percent, "0", "+" + percent};
}

const std::array<glm::vec3, 9>& value_colors() {
    static const std::array<glm::vec3, 9> colors = {
        from_hex(0x440154), from_hex(0x472d7b), from_hex(0x3b528b), from_hex(0x2c728e), from_hex(0x21908c),
        from_hex(0x27ad81), from_hex(0x5dc863), from_hex(0xaadc32), from_hex(0xfde725)};
    return colors;
}

ColorScale value_scale(const ColorMapView& map) {
    const Unit unit = unit_of(map.quantity, map.full);
    const auto number = [&](float value) { return fmt::format("{:.4g}", value / unit.size); };
    return {value_colors(), title_of(map.quantity), number(map.low), number(0.5f * (map.low + map.full)),
            number(map.full) + unit.name};
}

void set_strain_colors(const gl::Program& program, float full_strain) {
    set_colors(program, "strain_colors", strain_colors());
    program.set("full_strain", full_strain);
}

void set_value_colors(const gl::Program& program, const ColorMapView& map) {
    set_colors(program, "value_colors", value_colors());
    program.set("value_low", map.low);
    program.set("value_full", map.full);
}

Legend::Legend() : program_(gl::Program::graphics("render/legend.vert", "render/legend.frag")) {}

void Legend::show(const ColorScale& scale, int letter_size) {
    if (scale_ == scale && letter_size_ == letter_size) return;
    scale_ = scale;
    letter_size_ = letter_size;
    const Canvas canvas = paint(scale, letter_size);
    picture_ = Target::color(canvas.width, canvas.height, GL_RGBA8);
    gl::forget_state();  // a unit's binding changes
    glBindTexture(GL_TEXTURE_2D, picture_.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, canvas.width, canvas.height, GL_RGBA, GL_FLOAT,
                    canvas.pixels.data());
}

void Legend::draw(const View& view) const {
    program_.bind_texture("legend", picture_.texture());
    view.set_uniforms(program_);
    program_.draw_arrays(gl::Primitive::triangle_strip, 4);
}

}  // namespace gelatin::render
