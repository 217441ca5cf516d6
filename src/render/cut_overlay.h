#pragma once

#include <cstdint>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// The cut of a plane through bodies: for each intersected tet the polygon of the intersection, with thin
/// sides.
class CutOverlay {
public:
    CutOverlay();
    /// Lists the intersected tets. Ends with the barriers that drawing needs.
    void find(const RenderView& bodies);
    /// In the colours of the bodies, or of a quantity if there is one. @pre find, for the same bodies; depths
    /// are compared and written
    void draw(const Frame& frame, const RenderView& bodies) const;

private:
    gl::Program find_program_, plain_program_, colored_program_;
    gl::Buffer<std::uint32_t> met_tets_;
    gl::Buffer<std::uint32_t> draw_arguments_;  // of one indirect draw
};

}  // namespace gelatin::render
