#pragma once

#include <glm/vec3.hpp>

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Arrows from nodes of the surface; hidden parts are fainter.
class ArrowOverlay {
public:
    ArrowOverlay();
    void draw_velocities(const Frame& frame, const RenderView& bodies) const;
    /// Each begins with a dot, the contact point. Most point into their body.
    void draw_forces(const Frame& frame, const RenderView& bodies) const;

private:
    struct Style {
        glm::vec3 ink;  // sRGB
        float dot;      // radius, in widths of a shaft; 0: none
        float hidden;   // opacity of hidden parts
    };
    void draw(const Frame& frame, const RenderView& bodies, const ArrowView& arrows,
              const Style& style) const;

    gl::Program program_;
};

}  // namespace gelatin::render
