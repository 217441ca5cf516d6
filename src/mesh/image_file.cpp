#include "mesh/image_file.h"

#include <fmt/core.h>
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#include <stb/stb_image.h>

#include <limits>
#include <memory>

#include "gelatin/error.h"

namespace gelatin {
namespace {

constexpr int kLargest = 16384;  // [pixels] of a side, as OpenGL 4.3 has to allow

[[noreturn]] void refuse(const std::string& problem) {
    throw InvalidInput({{}, 0, {}, {}, problem});
}

const stbi_uc* bytes_of(const std::string& file) {
    return reinterpret_cast<const stbi_uc*>(file.data());
}

int size_of(const std::string& file) {
    return static_cast<int>(file.size());
}

}  // namespace

void check_image(const std::string& file) {
    const bool is_png = file.starts_with("\x89PNG\r\n\x1a\n"), is_jpeg = file.starts_with("\xff\xd8\xff");
    if (!is_png && !is_jpeg) refuse("is neither a PNG nor a JPEG file");
    int width = 0, height = 0, channels = 0;
    const bool is_small = file.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max());
    if (!is_small || stbi_info_from_memory(bytes_of(file), size_of(file), &width, &height, &channels) == 0)
        refuse("is damaged");
    if (width > kLargest || height > kLargest)
        refuse(fmt::format("has {} x {} pixels; at most {} x {} are allowed", width, height, kLargest,
                           kLargest));
}

TextureImage decode_image(const std::string& file) {
    check_image(file);
    TextureImage image;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> rows(
        stbi_load_from_memory(bytes_of(file), size_of(file), &image.width, &image.height, &channels, 4),
        stbi_image_free);
    if (rows == nullptr) refuse(fmt::format("is damaged: {}", stbi_failure_reason()));
    const std::size_t row = 4 * static_cast<std::size_t>(image.width);
    const auto height = static_cast<std::size_t>(image.height);
    image.pixels.reserve(row * height);
    for (std::size_t y = height; y-- > 0;)
        image.pixels.insert(image.pixels.end(), rows.get() + y * row, rows.get() + (y + 1) * row);
    return image;
}

}  // namespace gelatin
