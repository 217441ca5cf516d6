#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/elastic_system.h"
#include "gpu/implicit/step_buffers.h"
#include "gpu/implicit/tries.h"
#include "gpu/node_buffers.h"
#include "model/model.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {

/// The displacements d of a step as the least of
///   sum_i m_i / (2 h^2) |x_i + d_i - y_i|^2 + d^T K d / 2 - f^T d + sum of rows,
/// with elements to second order (ElasticSystem), and contacts by their law, friction among it. Each island
/// of bodies with rows in common is solved by itself. Newton's method: on rigid motions alone
/// (rigid_newton.comp), then on all nodes, with conjugate gradients, then on rigid motions again. A small
/// island takes one dispatch for all nodes (solve_islands.comp); others take three an iteration
/// (solve_product.comp, solve_residual.comp, solve_direction.comp), if there are any. The host does not know
/// how many are needed: each gives work groups to the next (large_islands.glsl).
/// CPU twin: cpu::StepSystem.
class StepSystem {
public:
    /// @param capacity without any, nothing is spent on rows
    /// @param small_chunks of nodes that a small island has at most; 0: none is small
    /// @pre small_chunks is at most packing::kChunksOfSmallIsland
    /// @param tries has to live as long; it solves where these make a part
    StepSystem(const Model& model, Tries& tries, const RowCapacity& capacity, std::uint32_t small_chunks);

    ElasticSystem elastic;
    /// m / h^2 (y - x) + f [N]; w: m / h^2 [N/m], 0 where a node is held; [nodes]
    gl::Buffer<glm::vec4>& loads() { return buffers_.loads.values; }
    /// d [m]; input: of held nodes, and a guess; output: of all; [nodes]
    gl::Buffer<glm::vec4>& displacements() { return buffers_.displacements.values; }
    /// Energy by which each may miss its least [J], shape [objects].
    gl::Buffer<float>& enough() { return buffers_.enough.values; }
    /// For programs of other stages of a part.
    StepBuffers& buffers() { return buffers_; }
    /// Makes room for other rows than before, which are lost. All programs that StepBuffers::bind was called
    /// for have to be bound again. @pre there was room for some
    void grow(const RowCapacity& capacity);
    /// Of conjugate gradients for each linearisation, at most; twice without rows. 10 at first.
    void set_iterations(int iterations);

    /// @param rows of objects; packing::kNone: a plane
    /// @param islands_of_bodies of each body the least one of its island; packing::kNone: it sleeps, all of
    /// its nodes are held, and nothing moves it. Of a row one side at least has an island.
    /// @pre they are within the capacity
    void set_rows(std::span<const StepRow> rows, std::span<const std::uint32_t> islands_of_bodies);
    /// Bodies as rigid ones, of what is in loads() and enough(). Ends with the barrier for who gathers them.
    /// @param at where the part begins
    void begin_bodies(const NodeBuffers& at) const;
    /// After it. @param at the same; elastic.linearise() was called with it
    /// Ends with the barrier for who reads displacements as storage.
    void solve(const NodeBuffers& at);

    /// What all its programs share, for those that make its input, and use what it has found.
    const StepBuffers& buffers() const { return buffers_; }
    const RowCapacity& capacity() const { return capacity_; }

    /// Of each island after the last solve; blocks until it has ended.
    std::vector<SolveState> states() const;
    /// Of each row that the host has set, after the last solve, in the order of islands and objects: s [m];
    /// w: what friction holds with at most [N]. Blocks, too.
    std::vector<glm::vec4> slips() const;

private:
    struct Programs {
        explicit Programs(const gl::Defines& rows);
        std::vector<const gl::Program*> all() const;
        gl::Program sums, bodies, begin, start, first_direction, product, residual, direction, finish;
    };
    struct RowPrograms {
        RowPrograms();
        std::vector<const gl::Program*> all() const;
        gl::Program begin, base, newton, move, linearise, begin_again, sum_step, line_search;
    };
    void bind_buffers() const;
    std::uint32_t iterations_of_round() const;
    void run(const gl::Program& program, std::uint32_t groups) const;
    void run_newton(float tolerance) const;
    void solve_large_islands();
    void run_round(std::uint32_t round) const;

    Tries* tries_;
    StepBuffers buffers_;
    Programs programs_;
    std::optional<RowPrograms> rows_;
    std::optional<gl::Program> small_islands_;  // if any may be small
    RowCapacity capacity_;
    int iterations_ = 10;
    gl::Buffer<std::uint32_t> rounds_;  // Dispatch: large_islands.glsl
    std::uint32_t row_count_ = 0;       // of those that the host has set
};

}  // namespace gelatin::gpu
