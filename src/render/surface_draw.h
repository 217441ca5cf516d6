#pragma once

#include "gelatin/views.h"
#include "gl/buffer.h"

namespace gelatin::render {

/// The buffers of a RenderView made ready for shaders/include/surface_fetch.glsl; as long-lived as the view.
class SurfaceDraw {
public:
    explicit SurfaceDraw(const RenderView& view);

    /// Draws all faces with the program in use. @pre a vertex array object is bound
    void draw() const;

private:
    RenderView view_;
    gl::BufferTexture node_positions_;
    gl::BufferTexture surface_vertices_;
    gl::BufferTexture vertex_normals_;
};

}  // namespace gelatin::render
