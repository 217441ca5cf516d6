#pragma once

#include <span>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/skin.h"

namespace gelatin::gpu {

/// The stage that moves the points of a skin with the nodes: shaders/sim/view/carry_skin.comp.
class CarrySkin {
public:
    explicit CarrySkin(std::span<const SkinPoint> points);

    /// Ends with the barriers that update_normals and drawing need.
    /// @param position_texels of the nodes @param out gets the points' positions: xyz [m], 1
    void run(const gl::BufferTexture& position_texels, const gl::Buffer<glm::vec4>& out) const;

private:
    gl::Program program_;
    gl::Buffer<SkinPoint> points_;
};

}  // namespace gelatin::gpu
