#pragma once

#include "gl/program.h"
#include "render/ambient_occlusion.h"
#include "render/frame.h"

namespace gelatin::render {

/// The floor and the backdrop around the bodies.
class Scenery {
public:
    /// A floor without shadows.
    Scenery();
    /// A floor with shadows. @param occlusion of the surfaces drawn
    explicit Scenery(const AmbientOcclusion& occlusion);

    /// Draws the floor, if the view has one, and the backdrop behind everything drawn before.
    /// @param shadows null: a floor without shadows @pre a vertex array object is bound
    void draw(const View& view, const Shadows* shadows) const;

    /// The position of the floor, for shaders/render/include/floor_color.glsl.
    static void set_floor_uniforms(const gl::Program& program, const View& view);

private:
    const AmbientOcclusion* occlusion_ = nullptr;  // null: a floor without shadows
    gl::Program floor_program_;
    gl::Program backdrop_program_;
};

}  // namespace gelatin::render
