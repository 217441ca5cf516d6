#pragma once

#include <initializer_list>
#include <optional>

#include "gl/program.h"
#include "render/ambient_occlusion.h"
#include "render/frame.h"

namespace gelatin::render {

/// Draws surfaces lit at each pixel.
class PixelLight {
public:
    /// @param occlusion of the surfaces drawn; null: all of the ambient light reaches everything
    /// @param is_cut by a plane
    explicit PixelLight(const AmbientOcclusion* occlusion = nullptr, bool is_cut = false);

    /// @pre a vertex array object is bound
    void draw(const Frame& frame, std::initializer_list<const Layer*> layers) const;

private:
    gl::Program make_program(const gl::Defines& more) const;
    void set_uniforms(const gl::Program& program, const Frame& frame, const Layer& layer) const;

    const AmbientOcclusion* occlusion_;
    bool is_cut_;
    gl::Program program_;
    mutable std::optional<gl::Program> textured_program_;  // made when textures are first drawn
};

}  // namespace gelatin::render
