#pragma once

#include <glm/vec2.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The volume term as shaders/sim/elasticity/volume_term.glsl reads it. All empty, and nothing bound, in
/// models without.
class VolumeTermBuffers {
public:
    explicit VolumeTermBuffers(const Model& model);

    /// Defines for a shader that includes it only where a model has the term.
    static gl::Defines defines(const Model& model);

    void bind(const gl::Program& program) const;

private:
    gl::TexelTable<VolumeStep> strips_;
    gl::TexelTable<std::uint32_t> slice_starts_;
    gl::TexelTable<glm::vec2> nodes_;
};

}  // namespace gelatin::gpu
