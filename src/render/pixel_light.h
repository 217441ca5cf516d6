#pragma once

#include <initializer_list>

#include "gl/program.h"
#include "render/ambient_occlusion.h"
#include "render/frame.h"

namespace gelatin::render {

/// Draws surfaces with their light worked out at each pixel.
class PixelLight {
public:
    /// @param occlusion of what is drawn; null: all of the ambient light reaches everything
    /// @param defines CUT: by a plane, "cut_plane" of the program
    explicit PixelLight(const AmbientOcclusion* occlusion = nullptr, const gl::Defines& defines = {});

    /// @pre a vertex array object is bound
    void draw(const Frame& frame, std::initializer_list<const Layer*> layers) const;

    const gl::Program& program() const { return program_; }

private:
    const AmbientOcclusion* occlusion_;
    gl::Program program_;
};

}  // namespace gelatin::render
