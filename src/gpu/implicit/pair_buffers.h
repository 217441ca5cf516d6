#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gpu/implicit/step_buffers.h"
#include "model/model.h"

namespace gelatin::gpu {

/// For how many there is a place.
struct PairCapacity {
    std::size_t slots = 0, searches = 0, leaf_pairs = 0, pairs = 0;

    /// For usual cases: they grow where a part needs more.
    static PairCapacity of(const Model& model);
};

/// What the stages of contact between objects pass on to each other in a part of a step. Each buffer is known
/// by the name of its block and that of its sampler in shaders/sim/implicit/.
class PairBuffers {
public:
    PairBuffers(const Model& model, const PairCapacity& wanted);

    /// Makes room for more; paths stay. What was bound has to be bound again.
    void grow(const PairCapacity& wanted);
    /// What the program's source names; but for what is bound to it by another name.
    void bind(const gl::Program& program) const;

    PairCapacity capacity;
    gl::Buffer<PairCounts> counts;          ///< one; block Counts, counts[0]
    StepBuffer<std::uint32_t> slot_starts;  ///< of each object, and the end: SlotStarts, slot_starts
    StepBuffer<PairSlot> slots;             ///< by object and other, ascending: PairSlots, pair_slots
    StepBuffer<NearPair> pairs;             ///< by slot: NearPairs, near_pairs (five texels)
    /// Where paths of nodes end: each goes straight to within a slack of it; xyz [m]; w: 1 / mass, 0 of held
    /// nodes. By node: PathEnds, path_ends.
    StepBuffer<glm::vec4> path_ends;
    StepBuffer<glm::vec4> motions;  ///< of objects, the mean of their nodes' paths [m]: Motions, motions

private:
    std::uint32_t object_count_;
};

}  // namespace gelatin::gpu
