#pragma once

#include <initializer_list>

#include "gl/program.h"
#include "render/frame.h"
#include "render/target.h"

namespace gelatin::render {

/// How much of the ambient light reaches each pixel of a view: worked out from the bodies' depths, in a
/// picture of half the size, before they are lit (Jimenez, Wu, Pesce and Jarabo 2016, "Practical realtime
/// strategies for accurate indirect occlusion").
class AmbientOcclusion {
public:
    /// How far away something is still felt, of the scene's extent.
    static constexpr float kReach = 0.12f;

    AmbientOcclusion();

    /// The pictures that are lit are of this size [pixels].
    void resize(int width, int height);

    /// @param occluders what stands in the way of light @pre a vertex array object is bound
    void draw(const Frame& frame, std::initializer_list<const SurfaceDraw*> occluders);

    /// For programs that use shaders/render/include/openness.glsl: how they are made, and what they need.
    static gl::Defines defines(const AmbientOcclusion* occlusion);
    void set_uniforms(const gl::Program& program) const;
    void bind_texture(const gl::Program& program) const;
    unsigned texture() const { return smooth_.texture(); }

private:
    void draw_depths(const View& view, std::initializer_list<const SurfaceDraw*> occluders) const;
    void set_view(const View& view) const;

    gl::Program depth_program_;
    gl::Program occlusion_program_;
    gl::Program blur_program_;
    Target depths_;
    Target rough_;   // openness and distance, each pixel of a tile by directions of its own
    Target smooth_;  // their mean: openness in [0, 1], distance [m], < 0 on the floor
    float width_ = 1.0f, height_ = 1.0f;  // of the pictures that are lit [pixels]
    float same_surface_ = 1.0f;           // [m]
};

}  // namespace gelatin::render
