#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// Names of objects, each in the middle of its box, in letters of pixels over all else.
class LabelOverlay {
public:
    LabelOverlay();
    void show(const ObjectView& objects);
    /// @pre show
    void draw(const View& view, const OverlayView& overlay) const;

private:
    gl::Program program_;
    std::vector<std::string> names_;
    Target font_;  // one glyph beside the other: red the letter, green what surrounds it
    gl::Buffer<glm::uvec2> letters_;
};

}  // namespace gelatin::render
