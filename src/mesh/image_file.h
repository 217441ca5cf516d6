#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gelatin {

/// A picture for a texture: its first row is the lowest.
struct TextureImage {
    int width = 0, height = 0;         ///< [pixels]
    std::vector<std::uint8_t> pixels;  ///< red, green, blue, alpha, sRGB values; shape [height][width][4]
};

/// Tests whether decode_image can read it, by its first bytes.
/// @param file a PNG or JPEG file's bytes @throws InvalidInput if it is something else, or too large
void check_image(const std::string& file);

/// @throws InvalidInput as check_image, and for files that are damaged
TextureImage decode_image(const std::string& file);

}  // namespace gelatin
