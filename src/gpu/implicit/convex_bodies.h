#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/step_buffers.h"
#include "model/contact/contact_surface.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Bodies that are convex at the start, which have self-contact only where they have lost distances: their
/// tets, and where that is. CPU twin: cpu::KeptDistances.
struct ConvexBodies {
    /// @param own whether bodies meet themselves: else there are none
    ConvexBodies(const Model& model, const ContactSurface& surface, bool own);

    /// What the program's source names.
    void bind(const gl::Program& program) const;

    std::uint32_t tet_count = 0;

private:
    gl::TexelTable<std::uint32_t> convex_bodies_;  // by object
    gl::TexelTable<glm::uvec4> tets_;
    gl::TexelTable<std::uint32_t> tet_bodies_;
    gl::TexelTable<glm::vec4> tet_inverses_, rest_positions_;
    gl::TexelTable<Box> rest_boxes_;     // of the trees' nodes at the start
    StepBuffer<glm::vec4> rotations_;    // by object, three columns
    StepBuffer<glm::uvec4> lost_boxes_;  // by object, two
};

}  // namespace gelatin::gpu
