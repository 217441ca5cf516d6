#pragma once

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Velocities as arrows from nodes of the surface; hidden ones are fainter.
class ArrowOverlay {
public:
    ArrowOverlay();
    void draw(const Frame& frame, const RenderView& bodies) const;

private:
    gl::Program program_;
};

}  // namespace gelatin::render
