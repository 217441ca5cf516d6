#pragma once

#include <optional>

#include "gelatin/views.h"
#include "gl/program.h"
#include "render/frame.h"

namespace gelatin::render {

/// Marks faces that touch, and draws the edges of all faces. Programs are compiled when they are first
/// needed.
class FaceOverlay {
public:
    void prepare(const OverlayView& overlay);
    void draw_marks(const Frame& frame, const OverlayView& overlay) const;
    void draw_edges(const Frame& frame) const;

private:
    std::optional<gl::Program> mark_program_, edge_program_;
};

}  // namespace gelatin::render
