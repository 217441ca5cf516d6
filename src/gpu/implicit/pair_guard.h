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

namespace gelatin::gpu {

/// Lets nodes go to where a solve wants them, as far as no pair of surfaces crosses on the way, and none goes
/// into a collider. CPU twins: cpu::Guard, cpu::ImplicitStep::guard.
///
/// Each pair is checked, and what fails is clipped, in contact_tuning::kGuardRounds rounds. Islands in which
/// pairs fail after that move as a whole, or not at all. Where nodes end beside their paths, pairs of these
/// have to be found anew, for another pass (StepClock::guards).
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
    /// Then, after it is known what bodies have lost (PairCounts::has_lost): whether that was all. If so,
    /// nothing goes on until close(); else pairs are found anew, and it runs again. Ends with the barrier for
    /// whoever reads the clock.
    void decide() const;
    /// After the last pass: the try goes on with where nodes are now; or the part is halved, as no way was
    /// found. In the shortest part nothing moves then. Ends with the barrier for whoever reads nodes or the
    /// clock.
    void close() const;

    /// Of each object: the first object of those with pairs in common, itself among them. GuardIslands,
    /// guard_islands.
    StepBuffer<std::uint32_t> islands;
    /// One; block Guard, guard[0].
    const gl::Buffer<GuardState>& found() const { return found_; }

private:
    struct Programs {
        explicit Programs(const Model& model);
        std::vector<const gl::Program*> all() const;
        gl::Program begin, frames, nodes, pairs, end, decide, close, stay;
    };
    void run_round(const gl::Program& program, std::uint32_t round) const;

    StepState* state_;
    PairBuffers* pairs_;
    std::uint32_t node_count_, object_count_, chunk_count_;
    bool has_colliders_;
    Programs programs_;
    gl::TexelTable<Chunk> chunks_;
    gl::TexelTable<std::uint32_t> node_objects_;
    gl::Buffer<GuardState> found_;
    gl::Buffer<Dispatch> dispatches_;       // by round: nodes, its pairs; the last: of what stays
    gl::Buffer<NodeClips> node_clips_;      // by node
    gl::Buffer<glm::vec4> half_spaces_;     // four a pair, one for each of its nodes
    gl::Buffer<std::uint32_t> clip_links_;  // of half spaces
    gl::Buffer<double> frame_sums_;         // by chunk
    gl::Buffer<std::uint32_t> marks_;       // by object
    StepBuffer<glm::vec4> wanted_, frames_;
};

}  // namespace gelatin::gpu
