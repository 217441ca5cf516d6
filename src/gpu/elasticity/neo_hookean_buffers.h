#pragma once

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Neo-Hookean tets by row of nodes, as shaders/sim/elasticity/neo_hookean.glsl reads them. Empty, and
/// nothing bound, in models without.
class NeoHookeanBuffers {
public:
    NeoHookeanBuffers() = default;
    explicit NeoHookeanBuffers(const Model& model);  ///< a row for each node
    /// @param rows nodes, or kNoNode
    NeoHookeanBuffers(const Model& model, std::span<const std::uint32_t> rows);

    /// Defines for a shader that includes it only where a model has such tets.
    static gl::Defines defines(const Model& model);

    void bind(const gl::Program& program) const;

private:
    gl::TexelTable<NeoHookeanStep> strips_;
    gl::TexelTable<std::uint32_t> slice_starts_;
};

}  // namespace gelatin::gpu
