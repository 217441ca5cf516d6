#include "render/label_overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "core/log.h"
#include "render/font.h"

namespace gelatin::render {
namespace {

constexpr int kRim = 1;  // round the letters [pixels]
constexpr int kAtlasWidth = 4096, kMostAtlasHeight = 16'384;

using Pixel = glm::u8vec2;  // coverage by the letters, and by them and their rim

std::uint8_t coverage_with_rim(const TextPicture& text, int x, int y) {
    std::uint8_t most = 0;
    for (int i = -kRim; i <= kRim; ++i) {
        for (int j = -kRim; j <= kRim; ++j) most = std::max(most, text.at(x + i, y + j));
    }
    return most;
}

// Names beside each other in rows of one height.
struct Atlas {
    int row_height;
    int x = 0, height = 0;
    std::vector<Pixel> pixels = {};

    // The lower left corner of a free place, or nothing where the atlas is full.
    std::optional<glm::ivec2> find_place(int width) {
        if (height == 0 || x + width > kAtlasWidth) {
            if (height + row_height > kMostAtlasHeight) return std::nullopt;
            height += row_height;
            pixels.resize(static_cast<std::size_t>(kAtlasWidth) * static_cast<std::size_t>(height));
            x = 0;
        }
        x += width;
        return glm::ivec2(x - width, height - row_height);
    }

    void add(const TextPicture& text, const glm::ivec2& corner, int width) {
        for (int row = 0; row < row_height; ++row) {
            for (int column = 0; column < width; ++column) {
                const std::size_t at = static_cast<std::size_t>(corner.y + row) * kAtlasWidth +
                                       static_cast<std::size_t>(corner.x + column);
                pixels[at] = {text.at(column - kRim, row - kRim),
                              coverage_with_rim(text, column - kRim, row - kRim)};
            }
        }
    }
};

}  // namespace

LabelOverlay::LabelOverlay() : program_(gl::Program::graphics("render/labels.vert", "render/labels.frag")) {}

void LabelOverlay::show(const ObjectView& objects, int letter_size) {
    if (letter_size == letter_size_ && std::ranges::equal(objects.names, names_)) return;
    names_.assign(objects.names.begin(), objects.names.end());
    letter_size_ = letter_size;
    paint_names();
}

void LabelOverlay::paint_names() {
    const Font font(letter_size_);
    label_height_ = font.line_height() + 2 * kRim;
    Atlas atlas{label_height_};
    std::vector<glm::uvec4> labels;
    for (std::size_t o = 0; o < names_.size(); ++o) {
        const TextPicture text = font.paint(names_[o]);
        if (text.width == 0) continue;
        const int width = std::min(text.width + 2 * kRim, kAtlasWidth);
        const std::optional<glm::ivec2> corner = atlas.find_place(width);
        if (!corner) {
            spdlog::warn("the names of {} objects do not fit into one texture and are not drawn",
                         names_.size() - o);
            break;
        }
        atlas.add(text, *corner, width);
        labels.emplace_back(o, corner->x, corner->y, width);
    }
    labels_ = gl::Buffer<glm::uvec4>(std::span<const glm::uvec4>(labels));
    if (labels.empty()) return;
    atlas_ = Target::color(kAtlasWidth, atlas.height, GL_RG8);
    gl::forget_state();  // a unit's binding changes
    glBindTexture(GL_TEXTURE_2D, atlas_.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kAtlasWidth, atlas.height, GL_RG, GL_UNSIGNED_BYTE,
                    atlas.pixels.data());
}

void LabelOverlay::draw(const View& view, const OverlayView& overlay) const {
    if (labels_.empty()) return;
    const gl::BufferTexture boxes(overlay.boxes, std::size_t{32} * overlay.box_count,
                                  gl::TexelFormat::rgba32f);
    const gl::BufferTexture roots(overlay.objects->roots, std::size_t{4} * names_.size(),
                                  gl::TexelFormat::r32ui);
    const gl::BufferTexture labels(labels_, gl::TexelFormat::rgba32ui);
    program_.bind("boxes", boxes);
    program_.bind("roots", roots);
    program_.bind("labels", labels);
    program_.bind_texture("atlas", atlas_.texture());
    view.set_uniforms(program_);
    program_.set("label_height", static_cast<float>(label_height_));
    program_.draw_arrays(gl::Primitive::triangles, 6 * labels_.size());
}

}  // namespace gelatin::render
