#pragma once

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Springs as lines coloured by strain, inside bodies as if of glass.
class SpringOverlay {
public:
    SpringOverlay();
    /// Takes over the nodes of `bodies`.
    void draw(const Frame& frame, const RenderView& bodies) const;

private:
    gl::Program spring_program_, glass_program_;
};

}  // namespace gelatin::render
