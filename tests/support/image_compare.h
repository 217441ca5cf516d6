#pragma once

#include <glm/vec3.hpp>

#include "render/image.h"

namespace gelatin::test {

/// How much two pictures of one size differ to the eye: the mean over colours of the absolute difference [0,
/// 255] after both are made a quarter as wide and high, so that a pixel's shift at an edge, which drivers are
/// free in, counts little.
double perceptual_difference(const render::Image& a, const render::Image& b);

/// The mean colour of a part of a picture, each component in [0, 255]. @pre the part is inside
glm::dvec3 mean_color(const render::Image& image, int x, int y, int width, int height);

}  // namespace gelatin::test
