#pragma once

#include <utility>

#include "render/image.h"

namespace gelatin::viewer {

/// A picture that panels can show. Move-only. @pre a context is current
class PictureTexture {
public:
    PictureTexture() = default;
    /// @throws GlError if the driver cannot create it.
    explicit PictureTexture(const render::Image& image);
    PictureTexture(PictureTexture&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    PictureTexture& operator=(PictureTexture&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~PictureTexture();

    unsigned name() const { return name_; }  ///< OpenGL's; 0: none

private:
    unsigned name_ = 0;
};

}  // namespace gelatin::viewer
