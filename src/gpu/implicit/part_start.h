#pragma once

#include <cstdint>
#include <vector>

#include "core/stage_timer.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/drive/sum_loads.h"
#include "gpu/implicit/pair_rows.h"
#include "gpu/implicit/step_state.h"
#include "gpu/implicit/step_system.h"
#include "gpu/model_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// A step that begins.
struct StepStart {
    double size;             ///< [s]
    bool divides = false;    ///< it is divided where bodies touch others
    bool is_next = false;    ///< state.from has nodes where the last step ended
    bool sleeps = false;     ///< nothing is made while all bodies rest
    bool is_driven = false;  ///< bodies do not rest: loads or hands act on them
};

/// Where a part of a step begins: what its system is made of. Without PairRows bodies touch colliders alone,
/// so each is an island by itself. Or the part is found to be too long: then the clock has a shorter one for
/// the next try. Nothing is read back. CPU twin: cpu::ImplicitStep.
class PartStart {
public:
    /// @param state, system which it writes, and which have to live as long, as have
    /// @param pairs those of bodies that touch each other; null: they do not
    /// @pre the system's capacity has a pair for each body, or there are no colliders
    PartStart(const Model& model, StepState& state, const StepSystem& system, PairRows* pairs = nullptr);

    /// After StepSystem::grow, or PairRows::grow.
    void bind_buffers() const;

    /// Once, when velocities of held nodes take them to where handles want them: copies nodes to state.from.
    /// With PairRows held ones go on from where the last step ended, as they may be blocked.
    /// @pre state.from has velocities from before handles changed them
    void begin_step(const NodeBuffers& nodes, const StepStart& step) const;
    /// After tries: held nodes of state.from have their velocities of begin_step() again, those of `nodes`.
    /// If bodies rest, nothing has any. Ends with the barrier for the next try.
    void end_step(const NodeBuffers& nodes) const;
    /// A try, up to where StepSystem::solve(state.from) goes on: all of what follows. Ends with the barrier
    /// for it.
    /// @param loads that were summed where the part begins; null if the model has none
    /// @param timer of the parts of the step, with the names that cpu::ImplicitStep has; null: none
    void run(const ModelBuffers& model, const SumLoads* loads, StageTimer* timer = nullptr) const;
    /// Where nodes would go. Ends with the barrier for who finds near pairs there.
    void predict(const ModelBuffers& model, const SumLoads* loads) const;
    /// When these are found: contacts, islands, and whether the part is short enough.
    void find_rows(const ModelBuffers& model, const SumLoads* loads) const;
    void linearise(const ModelBuffers& model, const SumLoads* loads) const;

private:
    struct Programs {
        Programs(const Model& model, bool has_planes, bool has_pairs);
        std::vector<const gl::Program*> all() const;
        gl::Program begin_step, end_step, begin_try, predict, count_rows, sum_bodies, place_rows, make_rows,
            find_targets, find_enough, sum_motions, follow_rotation;
        bool has_planes;
    };
    void run(const gl::Program& program, std::uint32_t groups) const;
    void run_always(const gl::Program& program, std::uint32_t groups) const;

    StepState& state_;
    const StepSystem& system_;
    PairRows* pairs_;
    std::uint32_t node_count_, body_count_, chunk_count_;
    [[maybe_unused]] bool has_loads_;
    Programs programs_;
    gl::TexelTable<float> wave_times_;  // of bodies [s]
    StepBuffer<StartSums> part_sums_;   // by chunk
    StepBuffer<ChunkRows> chunk_rows_;
    StepBuffer<BodyRows> body_rows_;
    StepBuffer<float> damping_times_;  // of nodes [s]
    StepBuffer<float> energies_;       // by chunk [J]
};

}  // namespace gelatin::gpu
