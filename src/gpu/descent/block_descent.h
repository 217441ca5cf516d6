#pragma once

#include "core/stage_timer.h"
#include "gl/program.h"
#include "gpu/descent/descent_moves.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/model_buffers.h"
#include "gpu/node_buffers.h"
#include "model/model.h"
#include "model/solver.h"

namespace gelatin::gpu {

/// Vertex block descent: start_descent.comp and take_back_tangled.comp of shaders/sim/descent/; then moves
/// lower a sum of elements in turn (DescentMoves). CPU twin: cpu::BlockDescent.
class BlockDescent {
public:
    BlockDescent(const Model& model, const DescentSettings& settings);

    /// A step of `step` seconds from `previous`; writes `current`. Ends with the barrier that whoever gathers
    /// the nodes as textures or storage needs.
    /// @param loads of this step; null in models without
    /// @param current's velocities are those one step before `previous` if `has_earlier`, else ignored
    /// @param timer of the parts of the step, with the names that cpu::BlockDescent has; null: none
    void run(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
             const NodeBuffers& current, double step, bool has_earlier, StageTimer* timer = nullptr);

private:
    void bind_buffers() const;
    void start(const ModelBuffers& model, const SumLoads* loads, const NodeBuffers& previous,
               const NodeBuffers& current, double step, bool has_earlier) const;
    void take_back_tangled(const NodeBuffers& current) const;

    DescentSettings settings_;
    std::uint32_t node_count_, tet_count_, object_count_;
    gl::Program start_program_, find_tangled_program_, take_back_program_;
    gl::TexelTable<std::uint32_t> node_objects_;
    gl::Buffer<std::uint32_t> is_tangled_;  // by object
    DescentMoves moves_;
};

}  // namespace gelatin::gpu
