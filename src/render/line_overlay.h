#pragma once

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Attachments: points as dots, lines between the two sides, and axes of joints. Bones, and dots at the nodes
/// that they carry. Hidden parts are fainter.
class LineOverlay {
public:
    LineOverlay();
    void draw(const Frame& frame, const OverlayView& overlay) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::render
