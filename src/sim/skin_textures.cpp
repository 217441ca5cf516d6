#include "sim/skin_textures.h"

#include <epoxy/gl.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/log.h"
#include "gelatin/error.h"
#include "gl/object_name.h"
#include "mesh/image_file.h"

namespace gelatin {
namespace {

double linear_of(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double srgb_of(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

void multiply(TextureImage& image, const glm::vec3& color) {
    if (color == glm::vec3(1.0f)) return;
    for (int channel = 0; channel < 3; ++channel) {
        std::uint8_t product[256];
        for (int value = 0; value < 256; ++value) {
            const double shown = srgb_of(linear_of(value / 255.0) * static_cast<double>(color[channel]));
            product[value] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shown, 0.0, 1.0)));
        }
        for (std::size_t k = static_cast<std::size_t>(channel); k < image.pixels.size(); k += 4)
            image.pixels[k] = product[image.pixels[k]];
    }
}

TextureImage image_of(const SurfaceMaterial& material) {
    TextureImage image{1, 1, {255, 255, 255, 255}};
    try {
        if (material.image != nullptr) image = decode_image(*material.image);
    } catch (const Error& error) {
        log_warning(fmt::format("the texture '{}' of material '{}' is left out: {}", material.image_name,
                                material.name, error.what()));
    }
    multiply(image, material.color);
    return image;
}

unsigned make_texture(const TextureImage& image) {
    unsigned texture = 0;
    glGenTextures(1, &texture);
    gl::forget_state();  // a unit's binding changes
    glBindTexture(GL_TEXTURE_2D, texture);
    const int levels = 1 + static_cast<int>(std::log2(std::max(image.width, image.height)));
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_SRGB8_ALPHA8, image.width, image.height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.pixels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glBindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

}  // namespace

SkinTextures::SkinTextures(const Skin& skin) : uvs_(std::span(skin.surface.uvs)) {
    for (const SurfaceMaterial& material : skin.look.materials)
        textures_.push_back(make_texture(image_of(material)));
    for (const MaterialTriangles& part : skin.surface.materials)
        parts_.push_back({part.triangles.first, part.triangles.count, textures_[part.material]});
}

SkinTextures::~SkinTextures() {
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    gl::forget_state();
}

void SkinTextures::set(RenderView& view) const {
    view.vertex_uvs = uvs_.id();
    view.textured = parts_;
}

}  // namespace gelatin
