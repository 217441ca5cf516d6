#pragma once

#include <initializer_list>

#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Draws surfaces with their light worked out at each pixel.
class PixelLight {
public:
    PixelLight();

    /// @pre a vertex array object and the shadows' textures are bound
    void draw(const Frame& frame, std::initializer_list<const Layer*> layers) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::render
