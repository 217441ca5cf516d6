#pragma once

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Edges of boxes as lines; hidden ones are fainter.
class BoxOverlay {
public:
    BoxOverlay();
    /// @pre as Overlay::draw, and faces are not culled; the same for the other kinds
    void draw(const View& view, const OverlayView& overlay) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::render
