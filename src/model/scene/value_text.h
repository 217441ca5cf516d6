#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace gelatin {

/// Values as scene files write them.
std::string text_of(double value);
std::string text_of(int value);
std::string text_of(bool value);
std::string text_of(const glm::dvec2& v);
std::string text_of(const glm::dvec3& v);
std::string text_of(const glm::ivec3& v);
std::string text_of(std::string_view text);  ///< quoted
std::string text_of(const char* text);       ///< quoted

}  // namespace gelatin
