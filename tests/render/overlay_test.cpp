#include "render/overlay.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "render/overlay_fixture.h"

namespace gelatin::render {
namespace {

// As in shaders/layouts/spring.glsl.
struct Spring {
    std::uint32_t i, j;
    float rest_length, stiffness;
};

INSTANTIATE_TEST_SUITE_P(Qualities, OverlayTest, kQualities, name_of_quality);

class BoxOverlayTest : public OverlayTest {
protected:
    // Two boxes round the ball, the second one smaller and a level below.
    Image draw_boxes(const std::vector<glm::uvec2>& shown) {
        const auto boxes = buffer_of<glm::vec4>(
            {glm::vec4(-0.45f, 0.15f, -0.45f, 0.0f), glm::vec4(0.45f, 0.75f, 0.45f, 0.0f),
             glm::vec4(-0.7f, 0.1f, -0.5f, 0.0f), glm::vec4(0.7f, 1.1f, 0.5f, 0.0f)});
        const auto list = buffer_of(shown);
        return draw({.boxes = boxes.id(),
                     .shown_boxes = list.id(),
                     .box_count = 2,
                     .shown_box_count = static_cast<std::uint32_t>(shown.size())});
    }
};
INSTANTIATE_TEST_SUITE_P(Qualities, BoxOverlayTest, kQualities, name_of_quality);

// Each of the twelve edges, at points along it that nothing hides, and beside it.
TEST_P(BoxOverlayTest, EdgesAreWhereTheyProject) {
    const Image plain = draw(), boxed = draw_boxes({{1, 0}});
    const glm::vec3 low(-0.7f, 0.1f, -0.5f), high(0.7f, 1.1f, 0.5f);
    int seen = 0;
    for (int edge = 0; edge < 12; ++edge) {
        const int axis = edge / 4;
        glm::vec3 from = low;
        if ((edge & 1) != 0) from[(axis + 1) % 3] = high[(axis + 1) % 3];
        if ((edge & 2) != 0) from[(axis + 2) % 3] = high[(axis + 2) % 3];
        for (const float along : {0.05f, 0.3f, 0.7f, 0.95f}) {
            glm::vec3 point = from;
            point[axis] += along * (high - low)[axis];
            const bool behind_ball =
                point.z < 0.0f && glm::distance(glm::vec2(point), glm::vec2(0.0f, 0.6f)) < 0.65f;
            if (behind_ball) continue;
            EXPECT_LT(lightness(color_at(boxed, point)), 0.75 * lightness(color_at(plain, point)))
                << "edge " << edge << " at " << along;
            ++seen;
        }
    }
    EXPECT_GE(seen, 36);
    const glm::vec3 beside(-0.6f, 1.0f, 0.5f);  // in the front side, on none of its edges
    EXPECT_NEAR(lightness(color_at(boxed, beside)), lightness(color_at(plain, beside)), 1.0);
}

TEST_P(BoxOverlayTest, HiddenEdgesAreFaintNotGone) {
    const Image plain = draw(), boxed = draw_boxes({{0, 0}});
    // Of the upper edges the back one is behind the ball, the front one before it. All rows that a line
    // touches.
    const auto loss = [&](const glm::vec3& point) {
        const glm::ivec2 pixel(project(point));
        const auto around = [&](const Image& image) {
            return lightness(test::mean_color(image, pixel.x, pixel.y - 2, 1, 5));
        };
        return around(plain) - around(boxed);
    };
    const double hidden = loss({0.03f, 0.75f, -0.45f}), shown = loss({0.03f, 0.75f, 0.45f});
    EXPECT_GT(hidden, 2.0);
    EXPECT_GT(shown, 2.0 * hidden);
}

TEST_P(BoxOverlayTest, LevelsFade) {
    const Image plain = draw();
    const glm::vec3 point(-0.7f, 0.6f, 0.5f);
    double last = 1e9;
    for (const std::uint32_t level : {0u, 1u, 3u}) {
        const double loss =
            lightness(color_at(plain, point)) - lightness(color_at(draw_boxes({{1, level}}), point));
        EXPECT_GT(loss, 10.0) << level;
        EXPECT_LT(loss, 0.8 * last) << level;
        last = loss;
    }
}

// A box round the eye: its edges behind the eye leave no trace, nor do those that pass it harm the others.
TEST_P(BoxOverlayTest, BoxesMayHoldTheEye) {
    const auto boxes =
        buffer_of<glm::vec4>({glm::vec4(-0.7f, 0.1f, -0.5f, 0.0f), glm::vec4(0.7f, 1.1f, 9.0f, 0.0f)});
    const auto list = buffer_of<glm::uvec2>({{0, 0}});
    const Image plain = draw();
    const Image boxed =
        draw({.boxes = boxes.id(), .shown_boxes = list.id(), .box_count = 1, .shown_box_count = 1});
    for (const float z : {-0.2f, 1.0f, 1.5f}) {
        const glm::vec3 point(-0.7f, 0.1f, z);
        EXPECT_LT(lightness(color_at(boxed, point)), 0.75 * lightness(color_at(plain, point))) << z;
    }
    int changed = 0;
    for (int y = 0; y < kOverlayHeight; ++y) {
        for (int x = 0; x < kOverlayWidth; ++x)
            changed += std::abs(boxed.at(x, y)[1] - plain.at(x, y)[1]) > 10;
    }
    EXPECT_LT(changed, kOverlayWidth * kOverlayHeight / 16) << "lines, not areas";
}

TEST_P(OverlayTest, MarkedFacesAloneChange) {
    const Image plain = draw();
    const std::uint32_t faces = view_.face_count;
    // Those in front of the ball, right of its middle.
    std::vector<std::uint32_t> marks(faces, 0);
    std::vector<glm::vec3> centers(faces);
    for (std::uint32_t f = 0; f < faces; ++f) {
        for (int k = 0; k < 3; ++k)
            centers[f] += glm::vec3(surfaces_[0].positions[surfaces_[0].faces[f][k]]) / 3.0f;
        marks[f] = centers[f].z > 0.25f && centers[f].x > 0.05f ? 1 : 0;
    }
    const auto buffer = buffer_of(marks);
    const Image marked = draw({.face_marks = buffer.id()});
    int on = 0, off = 0;
    for (std::uint32_t f = 0; f < faces; ++f) {
        if (centers[f].z < 0.25f) continue;
        const double change =
            lightness(color_at(marked, centers[f])) - lightness(color_at(plain, centers[f]));
        if (marks[f] == 1) {
            EXPECT_GT(change, 60.0) << f;
            ++on;
        } else if (centers[f].x < -0.05f) {
            EXPECT_NEAR(change, 0.0, 3.0) << f;
            ++off;
        }
    }
    EXPECT_GT(on, 20);
    EXPECT_GT(off, 20);
}

TEST_P(OverlayTest, MarkedFacesShineThroughWhatHidesThem) {
    std::vector<std::uint32_t> marks(view_.face_count, 0);
    for (std::uint32_t f = 0; f < view_.face_count; ++f) {
        bool is_behind = true;
        for (int k = 0; k < 3; ++k)
            is_behind = is_behind && surfaces_[0].positions[surfaces_[0].faces[f][k]].z < -0.3;
        marks[f] = is_behind ? 1 : 0;
    }
    const Image plain = draw();
    const auto buffer = buffer_of(marks);
    const Image marked = draw({.face_marks = buffer.id()});
    const glm::vec3 behind(0.0f, 0.6f, -0.4f), beside(0.3f, 0.6f, -0.26f);
    EXPECT_GT(lightness(color_at(marked, behind)), lightness(color_at(plain, behind)) + 25.0);
    EXPECT_NEAR(lightness(color_at(marked, beside)), lightness(color_at(plain, beside)), 3.0);
}

// Five springs beside one another: compressed, at rest, stretched.
TEST_P(OverlayTest, SpringsHaveTheColorsOfTheirStrain) {
    std::vector<glm::vec4> nodes;
    std::vector<Spring> springs;
    const float kStrains[] = {-0.2f, -0.05f, 0.0f, 0.05f, 0.1f};
    for (const float strain : kStrains) {
        const float x = -0.3f + 0.15f * static_cast<float>(springs.size());
        springs.push_back({static_cast<std::uint32_t>(nodes.size()),
                           static_cast<std::uint32_t>(nodes.size() + 1), 0.3f / (1.0f + strain), 1.0f});
        nodes.emplace_back(x, 0.45f, 0.0f, 1.0f);
        nodes.emplace_back(x, 0.75f, 0.0f, 1.0f);
    }
    const Image plain = draw();
    const auto node_buffer = buffer_of(nodes);
    const auto spring_buffer = buffer_of(springs);
    view_.overlay = {.springs = spring_buffer.id(), .spring_count = 5, .full_strain = 0.1f};
    // In place of the ball, with nodes of their own.
    const RenderView ball = view_;
    view_.node_positions = node_buffer.id();
    view_.node_count = static_cast<std::uint32_t>(nodes.size());
    view_.face_count = 0;
    const Image image = draw(view_.overlay);
    view_ = ball;

    const auto middle = [&](std::size_t s) { return color_at(image, {nodes[2 * s].x, 0.6f, 0.0f}); };
    EXPECT_GT(middle(0).b, middle(0).r + 80.0) << "compressed: blue";
    EXPECT_GT(middle(1).b, middle(1).r + 40.0);
    EXPECT_GT(middle(4).r, middle(4).b + 80.0) << "stretched: orange to red";
    EXPECT_GT(middle(3).r, middle(3).b + 40.0);
    EXPECT_LT(std::abs(middle(2).r - middle(2).b), 25.0) << "at rest: neither";
    EXPECT_LT(lightness(middle(0)), lightness(middle(1))) << "and the more, the darker";
    EXPECT_LT(lightness(middle(4)), lightness(middle(3)));
}

TEST_P(OverlayTest, SpringsShowThroughTheirBody) {
    // A spring across the ball, twice as long as at rest.
    std::vector<glm::vec4> nodes(view_.node_count);
    glBindBuffer(GL_COPY_READ_BUFFER, view_.node_positions);
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(16 * nodes.size()), nodes.data());
    const auto extreme = std::minmax_element(nodes.begin(), nodes.end(),
                                             [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto index = [&](auto node) { return static_cast<std::uint32_t>(node - nodes.begin()); };
    const auto springs = buffer_of<Spring>({{index(extreme.first), index(extreme.second), 0.4f, 1.0f}});
    const Image plain = draw();
    const Image image = draw({.springs = springs.id(), .spring_count = 1, .full_strain = 0.1f});
    const glm::vec3 inside = 0.5f * (glm::vec3(*extreme.first) + glm::vec3(*extreme.second));
    const glm::dvec3 color = color_at(image, inside);
    EXPECT_GT(color.r, color.g + 40.0) << "the spring; the ball is green";
    EXPECT_GT(color_at(plain, inside).g, color_at(plain, inside).r + 20.0);
}

// Two points, a line between them before the ball, and an axis behind it.
TEST_P(OverlayTest, AttachmentsAreWhereTheyProject) {
    const glm::vec3 left(-0.5f, 0.6f, 0.5f), right(0.5f, 0.6f, 0.5f), behind(0.0f, 0.6f, -0.6f);
    const auto lines = buffer_of<glm::vec4>(
        {glm::vec4(left, 0.0f), glm::vec4(left, 0.0f), glm::vec4(right, 0.0f), glm::vec4(right, 0.0f),
         glm::vec4(left, 1.0f), glm::vec4(right, 0.0f), glm::vec4(behind - glm::vec3(0.7f, 0.0f, 0.0f), 2.0f),
         glm::vec4(behind + glm::vec3(0.7f, 0.0f, 0.0f), 0.0f)});
    const Image plain = draw();
    const Image image = draw({.lines = lines.id(), .line_count = 4});
    for (const glm::vec3& point : {left, right}) {
        const glm::dvec3 color = color_at(image, point);
        EXPECT_GT(color.b, color.r + 60.0) << "blue at " << point.x;
    }
    const glm::ivec2 middle(project(0.5f * (left + right)));
    const auto around = [&](const Image& drawn, const glm::ivec2& pixel) {
        return test::mean_color(drawn, pixel.x, pixel.y - 2, 1, 5);
    };
    EXPECT_GT(around(image, middle).b, around(plain, middle).b + 40.0) << "over the green ball";
    const glm::ivec2 shown(project(behind + glm::vec3(0.65f, 0.0f, 0.0f)));
    EXPECT_GT(around(image, shown).r - around(image, shown).g, 15.0) << "the axis beside the ball";
    const glm::ivec2 hidden(project(behind + glm::vec3(0.2f, 0.0f, 0.0f)));
    EXPECT_GT(around(image, hidden).r, around(plain, hidden).r + 15.0) << "and through it";
    EXPECT_EQ(draw().pixels, plain.pixels) << "nothing stays";
}

// A bone behind the ball, and a node that it carries before it.
TEST_P(OverlayTest, BonesShowThroughBodies) {
    const glm::vec3 from(-0.2f, 0.6f, -0.6f), to(0.2f, 0.6f, -0.6f), node(0.0f, 0.8f, 0.5f);
    const auto lines = buffer_of<glm::vec4>(
        {glm::vec4(node, 4.0f), glm::vec4(node, 0.0f), glm::vec4(from, 3.0f), glm::vec4(to, 0.0f)});
    const Image plain = draw();
    const Image image = draw({.lines = lines.id(), .line_count = 2});
    const glm::dvec3 bone = color_at(image, 0.5f * (from + to));
    const glm::dvec3 body = color_at(plain, 0.5f * (from + to));
    EXPECT_LT(bone.r + bone.g + bone.b, 0.6 * (body.r + body.g + body.b)) << "dark";
    const glm::dvec3 carried = color_at(image, node);
    EXPECT_GT(carried.r, carried.b + 100.0) << "yellow";
}

// Heavy, though it is quick: LeakSanitizer crashes behind it ("Tracer caught signal 11").
class LegendHeavy : public OverlayTest {};
INSTANTIATE_TEST_SUITE_P(Qualities, LegendHeavy, kQualities);

// The legend's bar goes from one end of the colours to the other.
TEST_P(LegendHeavy, HasTheColorsOfTheScale) {
    const auto springs = buffer_of<Spring>({{0, 1, 1.0f, 1.0f}});
    const Image image = draw({.springs = springs.id(), .spring_count = 1, .full_strain = 0.1f});
    const auto at = [&](int x) { return test::mean_color(image, x, kOverlayHeight - 8, 1, 1); };
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(at(5)[channel], 255.0 * static_cast<double>(strain_colors().front()[channel]), 12.0);
        EXPECT_NEAR(at(5 + 60)[channel], 255.0 * static_cast<double>(strain_colors()[2][channel]), 12.0);
        EXPECT_NEAR(at(5 + 119)[channel], 255.0 * static_cast<double>(strain_colors().back()[channel]), 12.0);
    }
}

// Of what was shown once nothing stays, and where nothing is shown the picture has the same bits.
TEST_P(BoxOverlayTest, LeavesNoTrace) {
    const Image plain = draw();
    EXPECT_NE(draw_boxes({{0, 0}, {1, 1}}).pixels, plain.pixels);
    EXPECT_EQ(draw().pixels, plain.pixels);
}

// Blue and orange stay apart for those who lack a kind of cones: by their yellow-blue difference, not by red
// and green.
TEST(StrainColors, DifferForTheColorBlind) {
    const auto yellowness = [](const glm::vec3& c) { return 0.5f * (c.r + c.g) - c.b; };
    const auto& colors = strain_colors();
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_GT(yellowness(colors[colors.size() - 1 - i]) - yellowness(colors[i]), 0.5f);
}

}  // namespace
}  // namespace gelatin::render
