#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/row_tables.h"
#include "model/model.h"

namespace gelatin::gpu {

/// A buffer that programs write as a block, and read as one or as texels.
template <class T>
struct StepBuffer {
    StepBuffer() = default;
    /// Zero at first.
    StepBuffer(std::size_t size, gl::TexelFormat format)
        : values(std::vector<T>(std::max<std::size_t>(size, 1))), texels(values, format) {}

    /// To a block and to a sampler, each if the program has it.
    void bind(const gl::Program& program, std::string_view block, std::string_view sampler) const {
        program.bind_declared(block, values);
        program.bind_declared(sampler, texels);
    }

    gl::Buffer<T> values;
    gl::BufferTexture texels;
};

/// All values of a buffer; blocks until the device has written them.
template <class T>
std::vector<T> read(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

/// Most contacts of a step, and most pairs of objects that have any.
struct RowCapacity {
    std::size_t rows = 0, pairs = 0;
};

/// All that the programs of a StepSystem share. Each is known by the name of its block and that of its
/// sampler in shaders/sim/implicit/.
class StepBuffers {
public:
    /// @param small_chunks as in StepSystem
    StepBuffers(const Model& model, const RowCapacity& capacity, std::uint32_t small_chunks);

    /// What the program's source names; but for what is bound to it by another name.
    void bind(const gl::Program& program) const;
    /// Makes room for other rows than before, which are lost. What was bound has to be bound again.
    void grow(const RowCapacity& capacity);
    /// As StepSystem has it.
    void set_rows(std::span<const StepRow> rows, std::span<const std::uint32_t> islands_of_bodies);

    /// As they are on the device, with all that there is a place for; blocks.
    RowTables tables() const;

    /// The device makes islands: each may be as large as all bodies together.
    void unite_islands();
    /// Whether any island is larger than a work group solves by itself.
    bool has_large_islands() const { return has_large_islands_; }

    std::uint32_t object_count, chunk_count;
    StepBuffer<glm::vec4> loads, displacements;                               ///< by node, as in StepSystem
    StepBuffer<float> enough;                                                 ///< by object
    StepBuffer<glm::vec4> steps, residuals, preconditioned, products, bases;  ///< by node
    StepBuffer<BodyMotion> vectors, body_motions;                             ///< by object
    StepBuffer<SolveState> states;                                            ///< by island, two by turns
    StepBuffer<glm::vec4> slips;         ///< by row: s [m]; w: limit of friction [N]
    StepBuffer<ResidualSums> base_sums;  ///< by chunk
    StepBuffer<StepRow> rows;

private:
    void bind_bodies(const gl::Program& program) const;
    void bind_rows(const gl::Program& program) const;

    bool has_rows_, has_large_islands_ = false;
    std::uint32_t small_chunks_;
    RowTableSizes sizes_;
    gl::TexelTable<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> chunk_starts_;
    gl::TexelTable<float> weights_;
    StepBuffer<StepBodySums> body_sums_;
    StepBuffer<StepBody> bodies_;
    StepBuffer<BodyInverse> inverses_;
    StepBuffer<NodeBlock> blocks_;
    StepBuffer<ResidualSums> sums_, product_sums_;
    StepBuffer<BodyMotion> body_forces_;
    StepBuffer<float> lacks_, parts_;
    StepBuffer<glm::vec2> step_sums_;
    StepBuffer<StepIsland> islands_;
    StepBuffer<std::uint32_t> island_of_object_, island_bodies_, island_chunks_, coupling_starts_, couplings_,
        entry_starts_, row_entries_;
    StepBuffer<StepPair> pairs_;
    StepBuffer<glm::uvec2> row_chunks_;
    StepBuffer<glm::vec4> arms_, row_sums_, pair_sums_;
    StepBuffer<StepTangent> tangents_;
};

}  // namespace gelatin::gpu
