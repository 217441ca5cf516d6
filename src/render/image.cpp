#include "render/image.h"

#include <png.h>

#include "core/file.h"
#include "gelatin/error.h"

namespace gelatin::render {

void write_png(const std::filesystem::path& file, const Image& image) {
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    header.width = static_cast<png_uint_32>(image.width);
    header.height = static_cast<png_uint_32>(image.height);
    header.format = PNG_FORMAT_RGB;
    std::string content(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
    png_alloc_size_t bytes = content.size();
    if (!png_image_write_to_memory(&header, content.data(), &bytes, 0, image.pixels.data(), 0, nullptr)) {
        throw SystemError(file.string() + ": cannot be written as PNG: " + header.message);
    }
    content.resize(bytes);
    write_file(file, content);
}

Image read_png(const std::filesystem::path& file) {
    const std::string content = read_file(file);
    png_image header = {};
    header.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&header, content.data(), content.size())) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, std::string("is not a PNG picture: ") + header.message});
    }
    header.format = PNG_FORMAT_RGB;
    Image image(static_cast<int>(header.width), static_cast<int>(header.height));
    if (!png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr)) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, std::string("is a damaged PNG picture: ") + header.message});
    }
    return image;
}

}  // namespace gelatin::render
