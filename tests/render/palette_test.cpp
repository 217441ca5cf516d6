#include "render/palette.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace gelatin::render {
namespace {

TEST(PaletteTest, SrgbIsTheStandardsCurve) {
    EXPECT_NEAR(to_srgb(glm::vec3(0.5f)).r, 0.7354f, 1e-3f);
    EXPECT_NEAR(to_srgb(glm::vec3(0.001f)).r, 0.01292f, 1e-5f);
    for (const float c : {0.0f, 0.002f, 0.2f, 1.0f})
        EXPECT_NEAR(from_srgb(to_srgb(glm::vec3(c))).g, c, 1e-5f);
}

TEST(PaletteTest, EightColorsDifferAndThenRepeat) {
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_GT(glm::distance(to_srgb(palette_color(i)), to_srgb(palette_color(j))), 0.2f)
                << i << " " << j;
        }
    }
    EXPECT_EQ(palette_color(8), palette_color(0));
}

}  // namespace
}  // namespace gelatin::render
