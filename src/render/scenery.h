#pragma once

#include "gl/program.h"
#include "render/ambient_occlusion.h"
#include "render/frame.h"

namespace gelatin::render {

/// The floor and the backdrop round the bodies.
class Scenery {
public:
    /// Of a floor without shadows.
    Scenery();
    /// Of a floor with shadows. @param occlusion of what is drawn
    explicit Scenery(const AmbientOcclusion& occlusion);

    /// Draws the floor, if the view shows one, and the backdrop behind all that has been drawn.
    /// @param shadows null for a floor without @pre a vertex array object is bound
    void draw(const View& view, const Shadows* shadows) const;

    /// The place of the floor, for shaders/render/include/floor_color.glsl.
    static void set_floor_uniforms(const gl::Program& program, const View& view);

private:
    const AmbientOcclusion* occlusion_ = nullptr;  // null: a floor without shadows
    gl::Program floor_program_;
    gl::Program backdrop_program_;
};

}  // namespace gelatin::render
