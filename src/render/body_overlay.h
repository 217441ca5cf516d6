#pragma once

#include <optional>

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/pixel_light.h"

namespace gelatin::render {

/// Bodies in the colours of a quantity, or cut open, instead of the pipeline's own. Colours are shaded
/// lightly, so that they can be compared with the legend's. Programs are compiled when they are first needed.
class BodyOverlay {
public:
    void prepare(const OverlayView& overlay);
    /// @pre as Pipeline::draw, and the shadows' textures are bound
    void draw(const Frame& frame, const RenderView& bodies) const;
    /// What contacts press shines through what hides it. @pre pressures are shown, blending is on
    void draw_pressed(const Frame& frame, const RenderView& bodies) const;

private:
    void draw_colored(const Frame& frame, const RenderView& bodies, const gl::Program& program) const;

    std::optional<PixelLight> cut_light_;
    std::optional<gl::Program> colored_program_, pressed_program_;
};

}  // namespace gelatin::render
