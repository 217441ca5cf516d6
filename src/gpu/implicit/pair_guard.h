#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/pair_buffers.h"
#include "gpu/implicit/step_state.h"
#include "gpu/model_buffers.h"
#include "model/model.h"
#include "model/shared_constants.h"

namespace gelatin::gpu {

/// Lets nodes go to where a solve wants them, as far as no pair of surfaces crosses on the way, and none goes
/// into a collider. CPU twins: cpu::Guard, cpu::ImplicitStep::guard.
///
/// Each pair is checked, and what fails is clipped, in contact_tuning::kGuardRounds rounds. Islands in which
/// pairs fail after that move as a whole, or not at all. Where nodes end beside their paths, pairs of these
/// have to be found anew, for another try (StepClock::guards).
class PairGuard {
public:
    /// @param state, pairs have to live as long
    PairGuard(const Model& model, StepState& state, PairBuffers& pairs);

    /// After PairBuffers::grow.
    void grow();
    /// Moves nodes of state.to, which are where they are wanted, and ends of their paths. Needs `islands`,
    /// and of state `from`, the compliances in predicted, and the clock. Ends with the barrier for whoever
    /// reads nodes or paths.
    void run(const ModelBuffers& model) const;
    /// Then, after it is known what bodies have lost (PairCounts::has_lost): whether that was all. If not,
    /// the next try goes on with the guard alone. When it has run `most` times in a part, that is halved, as
    /// no way was found; in the shortest part nothing moves. Ends with the barrier for whoever reads nodes or
    /// the clock.
    void decide(std::uint32_t most = contact_tuning::kGuardPasses) const;

    /// Of each object: the first object of those with pairs in common, itself among them. GuardIslands,
    /// guard_islands.
    StepBuffer<std::uint32_t> islands;
    /// One; block Guard, guard[0].
    const gl::Buffer<GuardState>& found() const { return found_; }

private:
    struct Programs {
        explicit Programs(const Model& model);
        std::vector<const gl::Program*> all() const;
        gl::Program begin, frames, nodes, pairs, end, decide, stay;
    };
    void run(const gl::Program& program, std::size_t groups) const;
    void run_round(const gl::Program& program, std::uint32_t round) const;

    StepState* state_;
    PairBuffers* pairs_;
    std::uint32_t node_count_, object_count_, chunk_count_;
    bool has_colliders_;
    Programs programs_;
    gl::TexelTable<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> node_objects_;
    gl::Buffer<GuardState> found_;
    gl::Buffer<NodeClips> node_clips_;      // by node
    gl::Buffer<glm::vec4> half_spaces_;     // four a pair, one for each of its nodes
    gl::Buffer<std::uint32_t> clip_links_;  // of half spaces
    gl::Buffer<double> frame_sums_;         // by chunk
    gl::Buffer<std::uint32_t> marks_;       // by object
    StepBuffer<glm::vec4> wanted_, frames_;
};

}  // namespace gelatin::gpu
