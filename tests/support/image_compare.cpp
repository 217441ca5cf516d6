#include "support/image_compare.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace gelatin::test {

glm::dvec3 mean_color(const render::Image& image, int x, int y, int width, int height) {
    glm::dvec3 sum(0.0);
    for (int row = y; row < y + height; ++row) {
        for (int column = x; column < x + width; ++column) {
            const auto* pixel = image.at(column, row);
            sum += glm::dvec3(pixel[0], pixel[1], pixel[2]);
        }
    }
    return sum / (static_cast<double>(width) * height);
}

double perceptual_difference(const render::Image& a, const render::Image& b) {
    constexpr int kBlock = 4;
    if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    int blocks = 0;
    for (int y = 0; y < a.height; y += kBlock) {
        for (int x = 0; x < a.width; x += kBlock) {
            const int width = std::min(kBlock, a.width - x);
            const int height = std::min(kBlock, a.height - y);
            const glm::dvec3 difference =
                glm::abs(mean_color(a, x, y, width, height) - mean_color(b, x, y, width, height));
            sum += (difference.r + difference.g + difference.b) / 3.0;
            ++blocks;
        }
    }
    return blocks > 0 ? sum / blocks : 0.0;
}

}  // namespace gelatin::test
