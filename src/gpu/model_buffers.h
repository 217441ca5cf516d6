#pragma once

#include <glm/vec2.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/drive/pulls.h"
#include "gpu/elasticity/neo_hookean_buffers.h"
#include "gpu/elasticity/volume_term_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The immutable parts of a model that the solver's kernels read, on the GPU, and what acts on
/// it from outside.
struct ModelBuffers {
    gl::TexelTable<HalfSpringPair> half_springs;
    gl::TexelTable<glm::vec2> stiffnesses;  ///< of the pairs [N/m]
    gl::TexelTable<std::uint32_t> slice_starts;
    NeoHookeanBuffers neo_hookean;
    VolumeTermBuffers volume_term;
    gl::Buffer<Face> faces;
    gl::BufferTexture face_texels;
    gl::TexelTable<Collider> colliders;
    std::uint32_t node_count = 0;
    glm::uvec4 collider_ends{0};  ///< behind the planes, boxes, spheres, capsules
    glm::vec3 gravity{0.0f};      ///< [m/s^2]
    Pulls pulls;

    explicit ModelBuffers(const Model& model);

    /// Defines for a shader that includes sim/collision/colliders.glsl.
    static gl::Defines collider_defines(const Model& model);

    /// For programs that gather the springs of each node.
    void bind_half_springs(const gl::Program& program) const;

    /// For programs that include sim/collision/colliders.glsl.
    void bind_colliders(const gl::Program& program) const;
};

}  // namespace gelatin::gpu
