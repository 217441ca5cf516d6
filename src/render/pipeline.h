#pragma once

#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// A method to make a picture of a frame: one for each Quality.
class Pipeline {
public:
    Pipeline() = default;
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    virtual ~Pipeline() = default;

    /// @pre faces are culled and depths compared as Renderer::draw sets it; a vertex array object is bound
    virtual void draw(const Frame& frame) = 0;

    /// Sets the size of later pictures [pixels].
    virtual void resize(int width, int height) = 0;

    /// Where the finished picture is.
    virtual const Target& picture() const = 0;
};

}  // namespace gelatin::render
