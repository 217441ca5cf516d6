#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace gelatin::render {

/// The colour of object `index` if the scene gives none, linear RGB: eight hues that people with any kind of
/// dichromacy can distinguish (after Okabe and Ito 2008, softened), repeated.
glm::vec3 palette_color(std::size_t index);

/// As many colours as possible that distinguish objects: the palette's, then darker ones, then paler ones,
/// repeated. Linear RGB.
glm::vec3 object_color(std::size_t index);

/// Linear to sRGB and back, each component in [0, 1] (IEC 61966-2-1).
glm::vec3 to_srgb(const glm::vec3& linear);
glm::vec3 from_srgb(const glm::vec3& srgb);

}  // namespace gelatin::render
