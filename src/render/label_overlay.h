#pragma once

#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// Names of objects, each in the middle of its box, over all else.
class LabelOverlay {
public:
    LabelOverlay();
    /// @param letter_size [pixels]
    void show(const ObjectView& objects, int letter_size);
    /// @pre show
    void draw(const View& view, const OverlayView& overlay) const;

private:
    void paint_names();

    gl::Program program_;
    std::vector<std::string> names_;
    int letter_size_ = 0, label_height_ = 0;  // [pixels]
    Target atlas_;                            // all names; red the letters, green the letters and their rim
    gl::Buffer<glm::uvec4> labels_;
};

}  // namespace gelatin::render
