#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gelatin::render {

/// A picture: 8-bit sRGB, rows from the top.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;  ///< R, G, B of each pixel, shape [height][width][3]

    Image() = default;
    Image(int w, int h)
        : width(w), height(h), pixels(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

    const std::uint8_t* at(int x, int y) const { return pixels.data() + offset(x, y); }
    std::uint8_t* at(int x, int y) { return pixels.data() + offset(x, y); }

private:
    std::size_t offset(int x, int y) const {
        return 3 *
               (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

/// Writes a PNG file, completely or not at all.
/// @throws SystemError if it cannot be written.
void write_png(const std::filesystem::path& file, const Image& image);

/// @throws InvalidInput if the file is missing or is not PNG.
Image read_png(const std::filesystem::path& file);

}  // namespace gelatin::render
