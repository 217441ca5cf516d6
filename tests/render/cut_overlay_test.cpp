#include "render/cut_overlay.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "render/overlay_fixture.h"
#include "support/draw_vector.h"

namespace gelatin::render {
namespace {

struct Plane {
    glm::vec3 normal;
    float offset;

    CutView view() const { return {.plane = {normal.x, normal.y, normal.z, -offset}}; }
};

// Tets of a test's own in place of the ball.
class CutOverlayTest : public OverlayTest {
protected:
    using Tet = std::array<glm::vec3, 4>;

    Image draw_cut(const Plane& plane, const std::vector<Tet>& tets,
                   const std::optional<std::vector<float>>& values = {}) {
        std::vector<glm::vec4> nodes;
        std::vector<glm::uvec4> corners;
        for (const Tet& tet : tets) {
            const auto first = static_cast<std::uint32_t>(nodes.size());
            corners.emplace_back(first, first + 1, first + 2, first + 3);
            for (const glm::vec3& p : tet) nodes.emplace_back(p, 1.0f);
        }
        const auto node_buffer = buffer_of(nodes);
        const auto tet_buffer = buffer_of(corners);
        const auto object_buffer = buffer_of(std::vector<std::uint32_t>(tets.size(), 0u));
        const auto value_buffer = buffer_of(values.value_or(std::vector<float>{0.0f}));
        OverlayView overlay{.cut = plane.view()};
        overlay.cut->tets = tet_buffer.id();
        overlay.cut->tet_objects = object_buffer.id();
        overlay.cut->tet_count = static_cast<std::uint32_t>(tets.size());
        if (values)
            overlay.color_map =
                ColorMapView{.node_values = node_buffer.id(), .tet_values = value_buffer.id()};
        const RenderView ball = view_;
        view_.node_positions = node_buffer.id();
        view_.node_count = static_cast<std::uint32_t>(nodes.size());
        view_.face_count = 0;
        const Image image = draw(overlay);
        view_ = ball;
        return image;
    }

    // Where the eye's ray through a pixel's middle meets the plane.
    static glm::vec3 point_on(const Plane& plane, int x, int y) {
        static const glm::mat4 to_world = glm::inverse(
            kCamera.projection(static_cast<float>(kOverlayWidth) / kOverlayHeight) * kCamera.view());
        const glm::vec2 at((static_cast<float>(x) + 0.5f) / kOverlayWidth,
                           (static_cast<float>(y) + 0.5f) / kOverlayHeight);
        const glm::vec4 far = to_world * glm::vec4(2.0f * at.x - 1.0f, 1.0f - 2.0f * at.y, 1.0f, 1.0f);
        const glm::vec3 ray = glm::vec3(far) / far.w - kCamera.eye;
        return kCamera.eye +
               ray * ((plane.offset - glm::dot(plane.normal, kCamera.eye)) / glm::dot(plane.normal, ray));
    }

    static glm::mat3 to_barycentric(const Tet& tet) {
        return glm::inverse(glm::mat3(tet[1] - tet[0], tet[2] - tet[0], tet[3] - tet[0]));
    }

    // The least barycentric coordinate: negative outside.
    static float depth_in(const Tet& tet, const glm::mat3& barycentric, const glm::vec3& point) {
        const glm::vec3 b = barycentric * (point - tet[0]);
        return std::min(std::min(b.x, b.y), std::min(b.z, 1.0f - b.x - b.y - b.z));
    }
};
INSTANTIATE_TEST_SUITE_P(Qualities, CutOverlayTest, kQualities, name_of_quality);
using CutOverlayHeavy = CutOverlayTest;
INSTANTIATE_TEST_SUITE_P(Qualities, CutOverlayHeavy, kQualities, name_of_quality);

// Planes that part the corners in each possible way, pixel by pixel.
TEST_P(CutOverlayHeavy, ATetIsFilledWhereThePlaneIsInside) {
    const Tet tet{glm::vec3(-0.5f, 0.2f, 0.3f), glm::vec3(0.6f, 0.3f, 0.4f), glm::vec3(0.1f, 0.4f, -0.5f),
                  glm::vec3(0.0f, 1.1f, 0.1f)};
    const glm::mat3 barycentric = to_barycentric(tet);
    const Image plain = draw_cut({glm::vec3(0.0f, 0.0f, 1.0f), 9.0f}, {tet});
    std::mt19937 random(3);
    std::uniform_real_distribution<float> some(-1.0f, 1.0f);
    unsigned ways = 0;
    for (int i = 0; i < 80; ++i) {
        const glm::vec3 normal = glm::normalize(test::draw_vector<glm::vec3>(some, random));
        const glm::vec3 inside =
            0.25f * (tet[0] + tet[1] + tet[2] + tet[3]) + 0.15f * glm::vec3(some(random));
        const Plane plane{normal, glm::dot(normal, inside)};
        if (std::abs(glm::dot(normal, glm::normalize(kCamera.eye - inside))) < 0.2f)
            continue;  // seen from its edge
        unsigned way = 0;
        for (int k = 0; k < 4; ++k)
            way |= static_cast<unsigned>(glm::dot(normal, tet[k]) > plane.offset) << k;
        ways |= 1u << way;
        const Image image = draw_cut(plane, {tet});
        int wrong = 0, filled = 0;
        for (int y = 0; y < kOverlayHeight; ++y) {
            for (int x = 0; x < kOverlayWidth; ++x) {
                const float depth = depth_in(tet, barycentric, point_on(plane, x, y));
                if (std::abs(depth) < 0.03f) continue;  // an edge may share a pixel
                const bool is_changed = std::abs(image.at(x, y)[0] - plain.at(x, y)[0]) > 6;
                wrong += is_changed != (depth > 0.0f);
                filled += depth > 0.0f;
            }
        }
        EXPECT_EQ(wrong, 0) << "plane " << i << ", corners cut away " << way;
        EXPECT_TRUE(filled > 20 || depth_in(tet, barycentric, inside) < 0.05f) << i;
    }
    EXPECT_EQ(ways & 0x7ffeu, 0x7ffeu) << "not all ways were tried";
}

TEST_P(CutOverlayTest, EachTetHasTheColorOfItsValue) {
    std::vector<Tet> tets;
    std::vector<float> values;
    for (int i = 0; i < 70; ++i) {  // more than a work group
        const glm::vec3 at(0.16f * static_cast<float>(i % 10) - 0.72f,
                           0.15f + 0.14f * static_cast<float>(i / 10), 0.0f);
        tets.push_back({at + glm::vec3(-0.06f, -0.06f, 0.05f), at + glm::vec3(0.07f, -0.06f, 0.05f),
                        at + glm::vec3(0.0f, 0.07f, 0.05f), at + glm::vec3(0.0f, 0.0f, -0.2f)});
        values.push_back(static_cast<float>(i % 9) / 8.0f);
    }
    const Image image = draw_cut({glm::vec3(0.0f, 0.0f, 1.0f), 0.0f}, tets, values);
    for (std::size_t i = 0; i < tets.size(); ++i) {
        const glm::dvec3 color = color_at(image, glm::vec3(tets[i][3].x, tets[i][3].y, 0.0f));
        const glm::dvec3 right = 255.0 * glm::dvec3(value_colors()[i % 9]);
        EXPECT_LT(glm::distance(color, right), 6.0) << i;
    }
}

TEST_P(CutOverlayTest, SidesOfTetsAreThinLines) {
    // Two tets side by side over the picture's middle, seen as a square with a diagonal.
    const glm::vec3 a(-0.4f, 0.2f, 0.0f), b(0.4f, 0.2f, 0.0f), c(0.4f, 1.0f, 0.0f), d(-0.4f, 1.0f, 0.0f),
        behind(0.0f, 0.6f, -1.0f);
    const float shift = 0.05f;  // the plane is that far behind the square
    const Image image =
        draw_cut({glm::vec3(0.0f, 0.0f, 1.0f), -shift}, {{a, b, c, behind}, {a, c, d, behind}});
    const auto at = [&](const glm::vec3& p) {
        return lightness(color_at(image, glm::mix(p, behind, shift)));
    };
    const double inside = at({0.2f, 0.4f, 0.0f});
    EXPECT_NEAR(at({-0.2f, 0.8f, 0.0f}), inside, 2.0);
    for (const float along : {0.2f, 0.35f, 0.7f}) {
        double darkest = 255.0;
        for (int x = -1; x <= 1; ++x)
            darkest = std::min(
                darkest, at(glm::mix(a, c, along) + 0.004f * static_cast<float>(x) * glm::vec3(1, -1, 0)));
        EXPECT_LT(darkest, 0.8 * inside) << along;
    }
}

class CutBodiesTest : public OverlayTest {
protected:
    // The ball's surface, without tets inside.
    Image draw_cut_ball(const Plane& plane) {
        const auto tets = buffer_of<glm::uvec4>({glm::uvec4(0)});
        const auto objects = buffer_of<std::uint32_t>({0u});
        OverlayView overlay{.cut = plane.view()};
        overlay.cut->tets = tets.id();
        overlay.cut->tet_objects = objects.id();
        overlay.cut->tet_count = 1;
        return draw(overlay);
    }
    Image draw_nothing() {
        view_.face_count = 0;
        Image image = draw();
        view_ = body_.view();
        return image;
    }
};
INSTANTIATE_TEST_SUITE_P(Qualities, CutBodiesTest, kQualities, name_of_quality);

TEST_P(CutBodiesTest, WhatLiesBeyondThePlaneIsGone) {
    const Image plain = draw(), empty = draw_nothing();
    const Image cut = draw_cut_ball({{1.0f, 0.0f, 0.0f}, 0.05f});
    // As high as the ball's middle, where neither half throws a shadow on the other or on what is behind.
    for (const float x : {-0.3f, -0.2f, -0.1f})
        EXPECT_LT(glm::distance(color_at(cut, {x, 0.75f, 0.3f}), color_at(plain, {x, 0.75f, 0.3f})), 24.0)
            << x;
    for (const float x : {0.25f, 0.32f})
        EXPECT_LT(glm::distance(color_at(cut, {x, 0.75f, 0.2f}), color_at(empty, {x, 0.75f, 0.2f})), 16.0)
            << x;
    EXPECT_EQ(draw().pixels, plain.pixels) << "nothing stays of it";
}

TEST_P(CutBodiesTest, WhatIsLeftAloneCastsAShadow) {
    const Image plain = draw(), empty = draw_nothing();
    EXPECT_LT(test::perceptual_difference(draw_cut_ball({{1.0f, 0.0f, 0.0f}, -0.41f}), empty), 0.1);
    // Half of the shadow is the other half's: right of the ball and behind it, for light from the left.
    const auto shade = [&](const Image& image, const glm::vec3& place) {
        return lightness(color_at(empty, place)) - lightness(color_at(image, place));
    };
    const glm::vec3 under(0.1f, 0.0f, -0.1f), right(0.55f, 0.0f, -0.25f);
    const Image right_half = draw_cut_ball({{-1.0f, 0.0f, 0.0f}, 0.0f});
    const Image left_half = draw_cut_ball({{1.0f, 0.0f, 0.0f}, 0.0f});
    ASSERT_GT(shade(plain, right), 10.0);
    EXPECT_NEAR(shade(right_half, right), shade(plain, right), 6.0);
    EXPECT_LT(shade(left_half, right), 0.5 * shade(plain, right));
    EXPECT_GT(shade(left_half, under), 10.0) << "what is within casts it, too";
}

TEST_P(CutBodiesTest, SpringsBeyondThePlaneAreGone) {
    const std::vector<glm::vec4> nodes = {
        glm::vec4(-0.2f, 0.4f, 0.0f, 1.0f), glm::vec4(-0.2f, 0.8f, 0.0f, 1.0f),
        glm::vec4(0.2f, 0.4f, 0.0f, 1.0f), glm::vec4(0.2f, 0.8f, 0.0f, 1.0f)};
    struct Spring {
        std::uint32_t i, j;
        float rest_length, stiffness;
    };
    const auto node_buffer = buffer_of(nodes);
    const auto springs = buffer_of<Spring>({{0, 1, 0.3f, 1.0f}, {2, 3, 0.3f, 1.0f}});
    view_.node_positions = node_buffer.id();
    view_.node_count = 4;
    view_.face_count = 0;
    const Image image = draw({.springs = springs.id(),
                              .spring_count = 2,
                              .full_strain = 0.1f,
                              .cut = Plane{{1.0f, 0.0f, 0.0f}, 0.0f}.view()});
    const auto redness = [&](float x) {
        const glm::dvec3 color = color_at(image, {x, 0.6f, 0.0f});
        return color.r - color.b;
    };
    EXPECT_GT(redness(-0.2f), 60.0);
    EXPECT_LT(redness(0.2f), 10.0);
}

}  // namespace
}  // namespace gelatin::render
