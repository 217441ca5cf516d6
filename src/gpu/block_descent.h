#pragma once

#include <glm/vec2.hpp>

#include "gl/program.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// Vertex block descent: shaders/sim/start_descent.comp, mark_flat_tets.comp, descend.comp,
/// sum_rigid_motions.comp, move_bodies.comp. CPU twin: cpu::BlockDescent.
class BlockDescent {
public:
    /// @param iterations sweeps over all nodes in a step
    BlockDescent(const Model& model, int iterations);

    /// A step of `step` seconds from `previous`; writes `current`. Ends with the barrier that whoever gathers
    /// the nodes as textures or storage needs.
    void run(const ModelBuffers& model, const NodeBuffers& previous, const NodeBuffers& current,
             double step) const;

private:
    struct Color {
        std::uint32_t first_row, row_count;
    };

    void mark_flat_tets() const;
    void sweep(const ModelBuffers& model) const;
    void move_bodies(const NodeBuffers& current, bool is_last) const;

    gl::Program start_program_, mark_program_, sweep_program_, sum_program_, motion_program_, move_program_,
        last_move_program_;
    int iterations_;
    std::uint32_t tet_count_, object_count_;
    std::vector<Color> colors_;
    gl::Buffer<glm::uvec2> rows_;  // node, object
    NeoHookeanBuffers::Corners neo_hookean_corners_;
    gl::Buffer<HalfSpringPair> half_springs_;
    gl::Buffer<glm::vec2> stiffnesses_;
    gl::Buffer<std::uint32_t> spring_starts_;
    gl::Buffer<TetCorner> tet_corners_;
    gl::Buffer<std::uint32_t> corner_starts_;
    gl::Buffer<glm::uvec4> tets_;
    gl::Buffer<glm::vec2> tet_rests_;  // volume [m^3], modulus [Pa]
    gl::Buffer<Chunk> chunks_;
    gl::Buffer<std::uint32_t> chunk_starts_, is_pinned_;  // by object
    gl::BufferTexture row_texels_, half_spring_texels_, stiffness_texels_, spring_start_texels_,
        tet_corner_texels_, corner_start_texels_, tet_texels_, tet_rest_texels_, chunk_start_texels_,
        is_pinned_texels_;
    gl::Buffer<std::uint32_t> near_flat_, object_touches_;
    gl::Buffer<RigidSums> rigid_sums_;
    gl::Buffer<RigidMotion> motions_;
};

}  // namespace gelatin::gpu
