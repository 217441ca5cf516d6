#include "render/palette.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

namespace gelatin::render {

glm::vec3 to_srgb(const glm::vec3& linear) {
    const auto encode = [](float c) {
        return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
    };
    return {encode(linear.r), encode(linear.g), encode(linear.b)};
}

glm::vec3 from_srgb(const glm::vec3& srgb) {
    const auto decode = [](float c) {
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    return {decode(srgb.r), decode(srgb.g), decode(srgb.b)};
}

glm::vec3 palette_color(std::size_t index) {
    constexpr std::array<std::uint32_t, 8> kColors = {0xE4572E, 0x1FA187, 0xEEAD2A, 0x3A7CC8,
                                                      0xCD75B2, 0x6CBCE8, 0xEEE163, 0x697080};
    const std::uint32_t color = kColors[index % kColors.size()];
    return from_srgb(glm::vec3(color >> 16 & 255u, color >> 8 & 255u, color & 255u) / 255.0f);
}

glm::vec3 object_color(std::size_t index) {
    const glm::vec3 color = to_srgb(palette_color(index));
    switch (index / 8 % 3) {
        case 1:
            return from_srgb(0.6f * color);
        case 2:
            return from_srgb(glm::mix(color, glm::vec3(1.0f), 0.5f));
        default:
            return palette_color(index);
    }
}

}  // namespace gelatin::render
