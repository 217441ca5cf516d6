#include "mesh/text_outline.h"

#include <fmt/format.h>
#include <ft2build.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include FT_OUTLINE_H

#include "core/utf8.h"
#include "gelatin/error.h"
#include "mesh/font_face.h"

namespace gelatin {

namespace {

constexpr double kFlatness = 5e-3;     // largest distance of a polygon from its curve [em]
constexpr double kLeastLength = 1e-3;  // of a polygon's edge; shorter ones make mesh generators stumble [em]
constexpr double kLeastHeight = 1e-5;  // of a point above the line between its neighbours [em]

/// @throws InvalidInput at the first byte that is not UTF-8
std::vector<char32_t> decode(const std::string& text) {
    std::vector<char32_t> letters;
    for (std::size_t k = 0; k < text.size();) {
        const std::size_t begin = k;
        const std::optional<char32_t> letter = next_code_point(text, k);
        if (!letter) {
            const auto byte = static_cast<unsigned char>(text[begin]);
            throw InvalidInput(
                {{}, 0, "text", {}, fmt::format("byte {} is not UTF-8: {:#04x}", begin + 1, byte)});
        }
        letters.push_back(*letter);
    }
    return letters;
}

/// Takes FreeType's walk along a glyph's outline.
struct OutlineWalk {
    std::vector<Contour>& contours;
    glm::dvec2 origin;  // [em]
    double em;          // font units

    glm::dvec2 point(const FT_Vector* at) const {
        return origin + glm::dvec2(static_cast<double>(at->x), static_cast<double>(at->y)) / em;
    }
    glm::dvec2 last() const { return contours.back().back(); }

    /// Appends a curve's points behind its first one. A piece of a curve with second derivative below `bend`
    /// strays from its chord by at most bend h^2 / 8.
    template <class Curve>
    void append(const Curve& curve, double bend) {
        const int pieces = std::max(1, static_cast<int>(std::ceil(std::sqrt(bend / (8.0 * kFlatness)))));
        for (int k = 1; k <= pieces; ++k) contours.back().push_back(curve(static_cast<double>(k) / pieces));
    }
};

OutlineWalk& walk(void* user) {
    return *static_cast<OutlineWalk*>(user);
}

int move_to(const FT_Vector* to, void* user) {
    walk(user).contours.push_back({walk(user).point(to)});
    return 0;
}

int line_to(const FT_Vector* to, void* user) {
    walk(user).contours.back().push_back(walk(user).point(to));
    return 0;
}

int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    const glm::dvec2 a = walk(user).last(), b = walk(user).point(control), c = walk(user).point(to);
    const auto curve = [&](double t) { return (1 - t) * (1 - t) * a + 2 * t * (1 - t) * b + t * t * c; };
    walk(user).append(curve, 2.0 * glm::length(a - 2.0 * b + c));
    return 0;
}

int cubic_to(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to, void* user) {
    const glm::dvec2 a = walk(user).last(), b = walk(user).point(control1), c = walk(user).point(control2),
                     d = walk(user).point(to);
    const auto curve = [&](double t) {
        const double s = 1 - t;
        return s * s * s * a + 3 * t * s * s * b + 3 * t * t * s * c + t * t * t * d;
    };
    walk(user).append(curve, 6.0 * std::max(glm::length(a - 2.0 * b + c), glm::length(b - 2.0 * c + d)));
    return 0;
}

/// Drops points that are next to the point before them, then those on the line between their neighbours.
Contour clean(const Contour& contour) {
    Contour apart;
    for (const glm::dvec2& point : contour) {
        if (apart.empty() || glm::distance(point, apart.back()) >= kLeastLength) apart.push_back(point);
    }
    while (apart.size() > 1 && glm::distance(apart.front(), apart.back()) < kLeastLength) apart.pop_back();

    Contour bent;
    for (std::size_t k = 0; k < apart.size(); ++k) {
        const glm::dvec2 before = bent.empty() ? apart.back() : bent.back();
        const glm::dvec2 chord = apart[(k + 1) % apart.size()] - before, arm = apart[k] - before;
        const double height =
            std::abs(chord.x * arm.y - chord.y * arm.x) / std::max(glm::length(chord), kLeastLength);
        if (height >= kLeastHeight) bent.push_back(apart[k]);
    }
    return bent;
}

}  // namespace

std::vector<Contour> outline_text(const std::string& text, const std::string& font) {
    const std::vector<char32_t> letters = decode(text);
    const FontFace font_face(font);
    const FT_Face face = font_face.get();
    const double em = face->units_per_EM;

    std::vector<Contour> contours;
    OutlineWalk walker{contours, {0.0, 0.0}, em};
    const FT_Outline_Funcs steps{move_to, line_to, conic_to, cubic_to, 0, 0};
    FT_UInt previous = 0;
    for (const char32_t letter : letters) {
        if (letter == U'\n') {
            walker.origin = {0.0, walker.origin.y - face->height / em};
            previous = 0;
            continue;
        }
        const FT_UInt glyph = FT_Get_Char_Index(face, letter);
        if (glyph == 0 || FT_Load_Glyph(face, glyph, FT_LOAD_NO_SCALE) != 0) {
            throw InvalidInput({{},
                                0,
                                "text",
                                fmt::format("U+{:04X}", static_cast<std::uint32_t>(letter)),
                                "the font \"" + font + "\" has no such letter"});
        }
        FT_Vector kerning{0, 0};
        FT_Get_Kerning(face, previous, glyph, FT_KERNING_UNSCALED, &kerning);
        walker.origin.x += static_cast<double>(kerning.x) / em;
        FT_Outline_Decompose(&face->glyph->outline, &steps, &walker);
        walker.origin.x += static_cast<double>(face->glyph->metrics.horiAdvance) / em;
        previous = glyph;
    }

    std::vector<Contour> cleaned;
    for (const Contour& contour : contours) {
        Contour polygon = clean(contour);
        if (polygon.size() >= 3) cleaned.push_back(std::move(polygon));
    }
    return cleaned;
}

}  // namespace gelatin
