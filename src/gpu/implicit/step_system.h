#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/elastic_system.h"
#include "gpu/node_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// The displacements d of a step as the least of
///   sum_i m_i / (2 h^2) |x_i + d_i - y_i|^2 + d^T K d / 2 - f^T d,
/// with elements to second order (ElasticSystem), of each body by itself, by conjugate gradients
/// preconditioned by the nodes' own blocks and rigid motions: shaders/sim/implicit/solve_bodies.comp,
/// solve_residual.comp, solve_direction.comp, solve_product.comp. An iteration is three dispatches; what the
/// host does not know is whether it is needed: one behind the end of the solve does nothing. No contacts so
/// far. CPU twin: cpu::StepSystem.
class StepSystem {
public:
    explicit StepSystem(const Model& model);

    ElasticSystem elastic;
    gl::Buffer<glm::vec4>
        loads;  ///< m / h^2 (y - x) + f [N]; w: m / h^2 [N/m], 0 where a node is held; [nodes]
    gl::Buffer<glm::vec4>
        displacements;         ///< d [m]; input: of held nodes, and a guess; output: of all; [nodes]
    gl::Buffer<float> enough;  ///< energy by which each may miss its least [J], shape [objects]
    int iterations = 10;       ///< of conjugate gradients, at most twice

    /// @param at where the part begins; elastic.linearise() was called with it
    /// Ends with the barrier for who reads displacements as storage.
    void solve(const NodeBuffers& at) const;

    /// Of each object after the last solve; blocks until it has ended.
    std::vector<SolveState> states() const;

private:
    void bind_buffers() const;
    void dispatch(const gl::Program& program) const;

    gl::Program sum_program_, body_program_, begin_program_, residual_program_, direction_program_,
        product_program_, finish_program_;
    std::uint32_t object_count_, chunk_count_;
    gl::TexelTable<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> chunk_starts_;
    gl::Buffer<StepBodySums> body_sums_;
    gl::Buffer<StepBody> bodies_;
    gl::Buffer<ResidualSums> sums_;
    gl::Buffer<SolveState> states_;
    gl::Buffer<float> curvatures_;
    gl::Buffer<glm::vec4> steps_, residuals_, preconditioned_, products_;
    gl::BufferTexture load_texels_, displacement_texels_, enough_texels_, body_texels_, step_texels_,
        preconditioned_texels_, product_texels_;
};

}  // namespace gelatin::gpu
