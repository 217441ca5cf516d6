#pragma once

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Springs as lines coloured by strain, inside transparent bodies.
class SpringOverlay {
public:
    SpringOverlay();
    /// Uses the nodes of `bodies`.
    void draw(const Frame& frame, const RenderView& bodies) const;

private:
    gl::Program spring_program_, glass_program_;
};

}  // namespace gelatin::render
