#pragma once

#include "gl/program.h"
#include "render/ambient_occlusion.h"
#include "render/frame.h"

namespace gelatin::render {

/// The floor and the backdrop around the bodies.
class Scenery {
public:
    /// @param occlusion of the surfaces drawn; null: only that of the shadows
    explicit Scenery(const AmbientOcclusion* occlusion = nullptr);

    /// Draws the floor, if the view has one, and the backdrop behind everything drawn before.
    /// @param shadows null: a floor without shadows @pre a vertex array object and the shadows' textures are
    ///   bound
    void draw(const View& view, const Shadows* shadows) const;

    /// The position of the floor, for shaders/render/include/floor_color.glsl.
    static void set_floor_uniforms(const gl::Program& program, const View& view);

private:
    const AmbientOcclusion* occlusion_;
    gl::Program floor_program_;
    gl::Program backdrop_program_;
};

}  // namespace gelatin::render
