#pragma once

#include <glm/vec4.hpp>

#include "gelatin/views.h"
#include "gl/buffer.h"
#include "gl/program.h"

namespace gelatin::render {

/// The bodies of a z-up scene with y up, as everything is drawn: copies of what of a view is in space.
///
/// Needs the context in which it was made and to which the view's buffers belong.
class TurnedView {
public:
    TurnedView();

    /// Valid until the next call, or as long as the view. @pre as Renderer::draw
    RenderView turn(const RenderView& view);

private:
    unsigned copy(unsigned from, std::size_t count, gl::Buffer<glm::vec4>& to);

    gl::Program program_;
    gl::Buffer<glm::vec4> positions_, normals_, nodes_, boxes_, velocities_, forces_, lines_;
};

}  // namespace gelatin::render
