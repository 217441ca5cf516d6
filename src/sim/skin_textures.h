#pragma once

#include <span>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "model/skin.h"

namespace gelatin {

/// The textures of a skin: the images of its materials, multiplied by their colours, or these alone. Images
/// that cannot be decoded are left out, with a warning. Needs the context in which it was made.
class SkinTextures {
public:
    /// @pre the skin has materials
    explicit SkinTextures(const Skin& skin);
    SkinTextures(const SkinTextures&) = delete;
    SkinTextures& operator=(const SkinTextures&) = delete;
    ~SkinTextures();

    /// Sets the texture coordinates and textures of a view of the skin.
    void set(RenderView& view) const;

private:
    gl::Buffer<glm::vec2> uvs_;  // by surface vertex
    std::vector<unsigned> textures_;
    std::vector<TexturedTriangles> parts_;
};

}  // namespace gelatin
