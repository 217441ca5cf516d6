#include "gpu/implicit/pair_buffers.h"

#include <vector>

namespace gelatin::gpu {

PairCapacity PairCapacity::of(const Model& model) {
    const std::size_t objects = model.objects.size(), leaves = model.face_trees.levels[0].size();
    return {16 * objects, 4 * leaves + 1024, 16 * leaves + 4096,
            4 * (model.surface_parts.nodes.size() + model.surface_parts.edges.size()) + 4096};
}

PairBuffers::PairBuffers(const Model& model, const PairCapacity& wanted)
    : counts(std::vector<PairCounts>(1)),
      slot_starts(model.objects.size() + 1, gl::TexelFormat::r32ui),
      path_ends(model.positions.size(), gl::TexelFormat::rgba32f),
      motions(model.objects.size(), gl::TexelFormat::rgba32f),
      object_count_(static_cast<std::uint32_t>(model.objects.size())) {
    grow(wanted);
}

void PairBuffers::grow(const PairCapacity& wanted) {
    capacity = wanted;
    slots = {capacity.slots, gl::TexelFormat::rgba32ui};
    pairs = {capacity.pairs, gl::TexelFormat::rgba32ui};
}

void PairBuffers::bind(const gl::Program& program) const {
    program.set("object_count", object_count_);
    program.set("slot_capacity", static_cast<std::uint32_t>(capacity.slots));
    program.set("search_capacity", static_cast<std::uint32_t>(capacity.searches));
    program.set("leaf_pair_capacity", static_cast<std::uint32_t>(capacity.leaf_pairs));
    program.set("pair_capacity", static_cast<std::uint32_t>(capacity.pairs));
    program.bind_declared("Counts", counts);
    slot_starts.bind(program, "SlotStarts", "slot_starts");
    slots.bind(program, "PairSlots", "pair_slots");
    pairs.bind(program, "NearPairs", "near_pairs");
    path_ends.bind(program, "PathEnds", "path_ends");
    motions.bind(program, "Motions", "motions");
}

}  // namespace gelatin::gpu
