#pragma once

#include <cstdint>

#include "model/shared_constants.h"

namespace gelatin {

/// Faces in a word of the Face Collision Result, two bits each (src/cpu/collision/touch.h).
constexpr std::uint32_t kFacesAWord = packing::kFacesAWord;

/// Words of one pair for an object of so many faces.
constexpr std::uint32_t face_collision_words(std::uint32_t face_count) {
    return (face_count + kFacesAWord - 1) / kFacesAWord;
}

}  // namespace gelatin
