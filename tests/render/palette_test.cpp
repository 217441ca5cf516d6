#include "render/palette.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gelatin::render {
namespace {

TEST(PaletteTest, SrgbIsTheStandardsCurve) {
    EXPECT_NEAR(to_srgb(glm::vec3(0.5f)).r, 0.7354f, 1e-3f);
    EXPECT_NEAR(to_srgb(glm::vec3(0.001f)).r, 0.01292f, 1e-5f);
    for (const float c : {0.0f, 0.002f, 0.2f, 1.0f})
        EXPECT_NEAR(from_srgb(to_srgb(glm::vec3(c))).g, c, 1e-5f);
}

// CIELAB under daylight (CIE 15, D65) of linear sRGB: distances in it are about how different colours look.
glm::dvec3 lab(const glm::dvec3& rgb) {
    const glm::dmat3 to_xyz(0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375,
                            0.0721750, 0.9503041);
    const glm::dvec3 xyz = to_xyz * glm::clamp(rgb, 0.0, 1.0) / glm::dvec3(0.95047, 1.0, 1.08883);
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    return {116.0 * f(xyz.y) - 16.0, 500.0 * (f(xyz.x) - f(xyz.y)), 200.0 * (f(xyz.y) - f(xyz.z))};
}

struct Sight {
    const char* name;
    glm::dmat3 seen;  // what linear sRGB looks like; rows as columns
};

// Machado, Oliveira and Fernandes 2009, table 1, severity 1.
const Sight kSights[] = {
    {"usual", glm::dmat3(1.0)},
    {"protanopia",
     {0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998}},
    {"deuteranopia",
     {0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881}},
    {"tritanopia",
     {1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900}},
};

// About 2.3 is a difference that is just noticed side by side (Mahy, Van Eycken and Oosterlinck 1994).
TEST(PaletteTest, ColorsDifferToEverySight) {
    for (const Sight& sight : kSights) {
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const glm::dvec3 a = lab(glm::dvec3(palette_color(i)) * sight.seen);
                const glm::dvec3 b = lab(glm::dvec3(palette_color(j)) * sight.seen);
                EXPECT_GT(glm::distance(a, b), 15.0) << sight.name << ": " << i << " and " << j;
            }
        }
    }
}

TEST(PaletteTest, EightColorsRepeat) {
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(palette_color(8 + i), palette_color(i));
}

}  // namespace
}  // namespace gelatin::render
