#pragma once

#include <cstdint>

namespace gelatin {

/// Faces in a word of the Face Collision Result, two bits each (src/cpu/collision/face_contact.h). GLSL twin:
/// shaders/sim/collision/pairs.glsl.
constexpr std::uint32_t kFacesAWord = 16;

/// Words of one pair for an object of so many faces.
constexpr std::uint32_t face_collision_words(std::uint32_t face_count) {
    return (face_count + kFacesAWord - 1) / kFacesAWord;
}

}  // namespace gelatin
