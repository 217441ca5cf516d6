#pragma once

#include <optional>

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"
#include "render/pixel_light.h"

namespace gelatin::render {

/// Bodies in the colours of a quantity, or cut open, in place of the pipeline's own: colours have little
/// shade, so that the legend's are found again. Programs are made when they are first needed.
class BodyOverlay {
public:
    void prepare(const OverlayView& overlay);
    /// @pre as Pipeline::draw, and the shadows' textures are bound
    void draw(const Frame& frame, const RenderView& bodies) const;

private:
    void draw_colored(const Frame& frame, const RenderView& bodies) const;

    std::optional<PixelLight> cut_light_;
    std::optional<gl::Program> colored_program_;
};

}  // namespace gelatin::render
