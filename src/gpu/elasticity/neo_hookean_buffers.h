#pragma once

#include "gl/buffer.h"
#include "gl/program.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Neo-Hookean tets, and by row of nodes the tets that they are corners of, as
/// shaders/sim/elasticity/neo_hookean.glsl reads them. All empty, and nothing bound, in models without.
class NeoHookeanBuffers {
public:
    /// Corners in slices of 64 rows.
    class Corners {
    public:
        Corners() = default;
        /// @param rows nodes, or kNoNode
        Corners(const Model& model, std::span<const std::uint32_t> rows);

        void bind(const gl::Program& program) const;

    private:
        gl::TexelTable<std::uint32_t> entries_, slice_starts_;
    };

    explicit NeoHookeanBuffers(const Model& model);

    /// Defines for a shader that includes it only where a model has such tets.
    static gl::Defines defines(const Model& model);

    void bind_tets(const gl::Program& program) const;
    /// The tets, and the corners with a row for each node.
    void bind(const gl::Program& program) const;

private:
    gl::TexelTable<NeoHookeanTet> tets_;
    Corners corners_;
};

}  // namespace gelatin::gpu
