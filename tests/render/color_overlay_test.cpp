// What overlays show by colours, arrows, edges and names.
#include <epoxy/gl.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render/font.h"
#include "render/frame.h"
#include "render/legend.h"
#include "render/overlay_fixture.h"
#include "render/palette.h"

namespace gelatin::render {
namespace {

glm::dvec3 map_color(double value) {
    const double place = 8.0 * glm::clamp(value, 0.0, 1.0);
    const auto stop = std::min(static_cast<std::size_t>(place), std::size_t{7});
    return glm::mix(glm::dvec3(value_colors()[stop]), glm::dvec3(value_colors()[stop + 1]),
                    place - static_cast<double>(stop));
}

class ColorOverlayTest : public OverlayTest {
protected:
    std::vector<glm::vec4> nodes() const {
        std::vector<glm::vec4> nodes(view_.node_count);
        glBindBuffer(GL_COPY_READ_BUFFER, view_.node_positions);
        glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(16 * nodes.size()), nodes.data());
        return nodes;
    }
};
INSTANTIATE_TEST_SUITE_P(Qualities, ColorOverlayTest, kQualities, name_of_quality);

// Values rise with height, from below the range to above it.
TEST_P(ColorOverlayTest, TheSurfaceHasTheLegendsColorsInLittleShade) {
    std::vector<float> values;
    for (const glm::vec4& p : nodes()) values.push_back(p.y);
    const auto buffer = buffer_of(values);
    const Image image =
        draw({.color_map = ColorMapView{.node_values = buffer.id(), .low = 0.3f, .full = 0.85f}});
    for (const float y : {0.26f, 0.35f, 0.45f, 0.6f, 0.7f, 0.8f, 0.9f}) {
        const float z = std::sqrt(0.16f - (y - 0.6f) * (y - 0.6f));
        const glm::dvec3 color = color_at(image, {0.0f, y, z}) / 255.0;
        const glm::dvec3 full = map_color((static_cast<double>(y) - 0.3) / 0.55);
        const double shade = glm::length(color) / glm::length(full);
        EXPECT_GT(shade, 0.58) << y;
        EXPECT_LT(shade, 1.03) << y;
        EXPECT_LT(glm::distance(color, shade * full), 0.06) << y;
    }
}

// On the ball's far side, in the middle of what the eye sees of it.
TEST_P(ColorOverlayTest, WhatContactsPressShinesThroughBodies) {
    std::vector<float> values;
    for (const glm::vec4& p : nodes()) values.push_back(p.z < -0.3f ? 1.0f : 0.0f);
    const auto buffer = buffer_of(values);
    const auto picture = [&](Quantity quantity) {
        return draw({.color_map = ColorMapView{.quantity = quantity, .node_values = buffer.id()}});
    };
    const glm::vec3 behind(0.0f, 0.6f, -0.4f), above(0.0f, 0.95f, 0.1f);
    const Image pressure = picture(Quantity::pressure), stress = picture(Quantity::stress);
    EXPECT_GT(lightness(color_at(pressure, behind)), lightness(color_at(stress, behind)) + 60.0);
    EXPECT_LT(glm::distance(color_at(pressure, above), color_at(stress, above)), 2.0) << "none is there";
}

TEST_P(ColorOverlayTest, ObjectsGetColorsOfTheirOwn) {
    const auto boxes = buffer_of<glm::vec4>({glm::vec4(0.0f), glm::vec4(0.0f)});
    const auto roots = buffer_of<std::uint32_t>({0u});
    const Image image = draw({.boxes = boxes.id(), .box_count = 1, .objects = ObjectView{roots.id(), {}}});
    const glm::dvec3 color = color_at(image, {0.1f, 0.7f, 0.38f});
    EXPECT_GT(color.r, color.g + 40.0) << "the first one's, orange, on a ball that is green";
    EXPECT_GT(color_at(draw(), {0.1f, 0.7f, 0.38f}).g, color_at(draw(), {0.1f, 0.7f, 0.38f}).r + 20.0);
}

// Pixel by pixel: white where a letter covers all of it, and nothing is changed beyond the letters' rim.
TEST_P(ColorOverlayTest, NamesStandInTheMiddleOfTheirObjects) {
    const glm::vec3 low(-1.0f, 0.2f, -0.2f), high(-0.4f, 0.6f, 0.4f);
    const auto boxes =
        buffer_of<glm::vec4>({glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(low, 0.0f), glm::vec4(high, 0.0f)});
    const auto roots = buffer_of<std::uint32_t>({1u});
    const std::vector<std::string> none = {""}, names = {"Eb3\xc3\xa9\xe9"};  // the last byte is not UTF-8
    const auto picture = [&](const std::vector<std::string>& all) {
        return draw({.boxes = boxes.id(), .box_count = 2, .objects = ObjectView{roots.id(), all}});
    };
    const Image without = picture(none), with = picture(names);
    View view;
    view.height = kOverlayHeight;
    const TextPicture text = Font(view.letter_size()).paint(names.front());
    ASSERT_GT(text.width, 30);

    // Lower left corner of the text, whose label is centred in whole pixels.
    const glm::vec2 middle =
        project(0.5f * (low + high)) * glm::vec2(1.0f, -1.0f) + glm::vec2(0.0f, kOverlayHeight);
    const glm::ivec2 corner =
        glm::ivec2(glm::floor(middle - 0.5f * glm::vec2(text.width + 2, text.height + 2))) + 1;
    int white = 0;
    for (int y = 0; y < kOverlayHeight; ++y) {
        for (int x = 0; x < kOverlayWidth; ++x) {
            const int column = x - corner.x, row = kOverlayHeight - 1 - y - corner.y;
            const auto* before = without.at(x, y);
            const auto* after = with.at(x, y);
            if (text.at(column, row) == 255) {
                ++white;
                EXPECT_TRUE(after[0] == 255 && after[1] == 255 && after[2] == 255) << column << " " << row;
            }
            const bool is_beyond = column < -1 || row < -1 || column > text.width || row > text.height;
            EXPECT_TRUE(!is_beyond || std::equal(after, after + 3, before)) << column << " " << row;
        }
    }
    EXPECT_GT(white, 10);
}

TEST_P(ColorOverlayTest, AsManyNamesAsFitIntoATextureAreDrawn) {
    const std::size_t count = 20'000;
    const auto boxes = buffer_of(std::vector<glm::vec4>(2 * count, glm::vec4(0.0f)));
    const auto roots = buffer_of(std::vector<std::uint32_t>(count, 0));
    const std::vector<std::string> few = {"alike"}, many(count, "alike");
    const auto picture = [&](const std::vector<std::string>& names) {
        return draw({.boxes = boxes.id(),
                     .box_count = static_cast<std::uint32_t>(count),
                     .objects = ObjectView{roots.id(), names}});
    };
    EXPECT_NE(picture(few).pixels, draw().pixels);
    EXPECT_NE(picture(many).pixels, draw().pixels);
}

TEST_P(ColorOverlayTest, EdgesOfFacesAreDrawnAndTheirMiddlesStay) {
    const Image plain = draw(), image = draw({.wireframe = true});
    double on_edges = 0.0, in_middles = 0.0;
    int count = 0;
    for (const glm::uvec3& face : surfaces_[0].faces) {
        const glm::vec3 a(surfaces_[0].positions[face.x]), b(surfaces_[0].positions[face.y]),
            c(surfaces_[0].positions[face.z]);
        if ((a + b + c).z < 0.9f) continue;
        ++count;
        const auto loss = [&](const glm::vec3& p) {
            return lightness(color_at(plain, p)) - lightness(color_at(image, p));
        };
        on_edges += loss(0.5f * (a + b));
        in_middles += loss((a + b + c) / 3.0f);
    }
    EXPECT_GT(count, 20);
    EXPECT_GT(on_edges / count, 8.0);
    EXPECT_LT(in_middles / count, 0.35 * on_edges / count);
}

class ArrowTest : public ColorOverlayTest {
protected:
    // Of the nodes at these places alone; the ball stays, in front of some of them.
    Image draw_arrows(const std::vector<glm::vec3>& places, const std::vector<glm::vec3>& speeds, float time,
                      bool are_forces = false) {
        std::vector<glm::vec4> positions = nodes();
        std::vector<glm::vec4> velocities(positions.size(), glm::vec4(0.0f));
        std::vector<std::uint32_t> arrows;
        for (std::size_t i = 0; i < places.size(); ++i) {
            arrows.push_back(static_cast<std::uint32_t>(positions.size()));
            positions.emplace_back(places[i], 1.0f);
            velocities.emplace_back(speeds[i], 0.0f);
        }
        const auto position_buffer = buffer_of(positions), velocity_buffer = buffer_of(velocities);
        const auto arrow_buffer = buffer_of(arrows);
        const RenderView ball = view_;
        view_.node_positions = position_buffer.id();
        view_.node_count = static_cast<std::uint32_t>(positions.size());
        OverlayView overlay;
        (are_forces ? overlay.contact_forces : overlay.arrows) =
            ArrowView{.nodes = arrow_buffer.id(),
                      .vectors = velocity_buffer.id(),
                      .count = static_cast<std::uint32_t>(arrows.size()),
                      .scale = time};
        const Image image = draw(overlay);
        view_ = ball;
        return image;
    }
};
INSTANTIATE_TEST_SUITE_P(Qualities, ArrowTest, kQualities, name_of_quality);

TEST_P(ArrowTest, GoAsFarAsTheNodeWillAndHaveAHead) {
    const glm::vec3 from(-0.9f, 0.15f, 0.5f), velocity(3.0f, 0.0f, 0.0f);
    const Image plain = draw(), image = draw_arrows({from}, {velocity}, 0.25f);
    const auto loss = [&](const glm::vec3& p) {
        return lightness(color_at(plain, p)) - lightness(color_at(image, p));
    };
    for (const float along : {0.05f, 0.3f, 0.6f, 0.9f})
        EXPECT_GT(loss(from + 0.25f * along * velocity), 60.0) << along;
    EXPECT_NEAR(loss(from + 0.25f * 1.1f * velocity), 0.0, 3.0);
    EXPECT_NEAR(loss(from - 0.25f * 0.1f * velocity), 0.0, 3.0);
    // How many rows are dark, in the shaft and towards the tip.
    const auto dark_rows = [&](float along) {
        const glm::ivec2 pixel(project(from + 0.25f * along * velocity));
        int rows = 0;
        for (int y = pixel.y - 8; y <= pixel.y + 8; ++y)
            rows += lightness(test::mean_color(image, pixel.x, y, 1, 1)) < 90.0;
        return rows;
    };
    EXPECT_GE(dark_rows(0.9f), dark_rows(0.5f) + 3);
}

TEST_P(ArrowTest, RestHasNone) {
    EXPECT_EQ(draw_arrows({{-0.9f, 0.15f, 0.5f}}, {glm::vec3(0.0f)}, 0.25f).pixels, draw().pixels);
}

TEST_P(ArrowTest, HiddenOnesAreFaint) {
    const glm::vec3 behind(-0.2f, 0.6f, -0.6f), beside(-0.2f, 0.13f, 0.6f), velocity(0.4f, 0.0f, 0.0f);
    const Image plain = draw(), image = draw_arrows({behind, beside}, {velocity, velocity}, 1.0f);
    const auto change = [&](const glm::vec3& from) {
        const glm::vec3 p = from + 0.4f * velocity;
        return glm::distance(color_at(plain, p), color_at(image, p));
    };
    EXPECT_GT(change(behind), 4.0);
    EXPECT_GT(change(beside), 2.5 * change(behind));
}

// Red, from a dot that stays however small the force is; well visible behind a body.
TEST_P(ArrowTest, ForcesBeginWithADot) {
    const glm::vec3 beside(-0.9f, 0.15f, 0.5f), behind(-0.2f, 0.6f, -0.6f);
    const glm::vec3 force(3.0f, 0.0f, 0.0f), small(1e-3f, 0.0f, 0.0f);
    const auto is_red = [&](const Image& image, const glm::vec3& p) {
        const glm::dvec3 color = color_at(image, p);
        return color.r > color.g + 60.0 && color.r > color.b + 60.0;
    };
    const Image long_one = draw_arrows({beside}, {force}, 0.25f, true),
                short_one = draw_arrows({beside}, {small}, 0.25f, true);
    EXPECT_TRUE(is_red(long_one, beside + 0.125f * force));
    EXPECT_TRUE(is_red(short_one, beside));
    EXPECT_FALSE(is_red(draw_arrows({beside}, {small}, 0.25f), beside)) << "a velocity has none";
    const glm::vec3 middle = behind + glm::vec3(0.1f, 0.0f, 0.0f);
    const auto change = [&](bool are_forces) {
        const Image image = draw_arrows({behind}, {{0.2f, 0.0f, 0.0f}}, 1.0f, are_forces);
        return glm::distance(color_at(draw(), middle), color_at(image, middle));
    };
    EXPECT_GT(change(true), 2.0 * change(false));
}

TEST(ValueScale, HasUnitsThatKeepNumbersShort) {
    const auto ends = [](Quantity quantity, float low, float full) {
        const ColorScale scale = value_scale({.quantity = quantity, .low = low, .full = full});
        return scale.low + "|" + scale.middle + "|" + scale.high;
    };
    EXPECT_EQ(ends(Quantity::stretch, 1.0f, 1.05f), "1|1.025|1.05");
    EXPECT_EQ(ends(Quantity::stress, 0.0f, 500.0f), "0|250|500 Pa");
    EXPECT_EQ(ends(Quantity::stress, 0.0f, 2e4f), "0|10|20 kPa");
    EXPECT_EQ(ends(Quantity::stress, 0.0f, 3e6f), "0|1.5|3 MPa");
    EXPECT_EQ(ends(Quantity::stress, 0.0f, 2e9f), "0|1|2 GPa");
    EXPECT_EQ(ends(Quantity::pressure, 0.0f, 2e4f), "0|10|20 kPa");
    EXPECT_EQ(ends(Quantity::speed, 0.0f, 5.0f), "0|2.5|5 m/s");
    EXPECT_EQ(ends(Quantity::speed, 0.0f, 0.05f), "0|25|50 mm/s");
}

// Björn Ottosson, "A perceptual color space for image processing" (Oklab), 2020.
glm::dvec3 oklab(const glm::vec3& srgb) {
    const glm::dvec3 c(from_srgb(srgb));
    const glm::dvec3 lms = glm::pow(glm::dvec3(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b,
                                               0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b,
                                               0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b),
                                    glm::dvec3(1.0 / 3.0));
    return {0.2104542553 * lms.x + 0.7936177850 * lms.y - 0.0040720468 * lms.z,
            1.9779984951 * lms.x - 2.4285922050 * lms.y + 0.4505937099 * lms.z,
            0.0259040371 * lms.x + 0.7827717662 * lms.y - 0.8086757660 * lms.z};
}

// Equal steps look about equal, and lightness alone orders them: nobody needs to distinguish red from green.
TEST(ValueColors, RiseEvenlyInLightness) {
    const auto& colors = value_colors();
    double least = 1.0, most = 0.0;
    for (std::size_t i = 0; i + 1 < colors.size(); ++i) {
        const glm::dvec3 a = oklab(colors[i]), b = oklab(colors[i + 1]);
        EXPECT_GT(b.x - a.x, 0.04) << i;
        least = std::min(least, glm::distance(a, b));
        most = std::max(most, glm::distance(a, b));
    }
    EXPECT_LT(most, 1.8 * least);
}

TEST(ObjectColors, ManyDifferBeforeTheyRepeat) {
    for (std::size_t i = 0; i < 24; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(glm::distance(to_srgb(object_color(i)), to_srgb(object_color(j))), 0.05f)
                << i << " " << j;
    }
    EXPECT_EQ(object_color(24), object_color(0));
}

}  // namespace
}  // namespace gelatin::render
