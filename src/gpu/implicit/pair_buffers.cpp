#include "gpu/implicit/pair_buffers.h"

#include <algorithm>
#include <vector>

namespace gelatin::gpu {

PairCapacity PairCapacity::of(const Model& model) {
    const std::size_t objects = model.objects.size(), leaves = model.face_trees.levels[0].size();
    return {16 * objects, 4 * leaves + 1024, 16 * leaves + 4096,
            4 * (model.surface_parts.nodes.size() + model.surface_parts.edges.size()) + 4096};
}

PairBuffers::PairBuffers(const Model& model, const ContactSurface& surface, const PairCapacity& wanted)
    : counts(std::vector<PairCounts>(1)),
      slot_starts(model.objects.size() + 1, gl::TexelFormat::r32ui),
      path_ends(model.positions.size(), gl::TexelFormat::rgba32f),
      slacks(model.objects.size(), gl::TexelFormat::r32f),
      motions(model.objects.size(), gl::TexelFormat::rgba32f),
      object_count_(static_cast<std::uint32_t>(model.objects.size())),
      body_count_(static_cast<std::uint32_t>(model.body_count())),
      thicknesses_(std::vector<float>(surface.thicknesses.begin(), surface.thicknesses.end()),
                   gl::TexelFormat::r32f) {
    grow(wanted);
}

void PairBuffers::grow(const PairCapacity& wanted) {
    capacity = wanted;
    slots = {capacity.slots, gl::TexelFormat::rgba32ui};
    pairs = {capacity.pairs, gl::TexelFormat::rgba32ui};
}

void PairBuffers::bind(const gl::Program& program) const {
    const auto bind_one = [&](const char* name, const auto& buffer) {
        if (program.declares(name)) program.bind(name, buffer);
    };
    const auto bind_both = [&](const char* block, const char* sampler, const auto& buffer) {
        bind_one(block, buffer.values);
        bind_one(sampler, buffer.texels);
    };
    program.set("object_count", object_count_);
    program.set("body_count", body_count_);
    program.set("slot_capacity", static_cast<std::uint32_t>(capacity.slots));
    program.set("search_capacity", static_cast<std::uint32_t>(capacity.searches));
    program.set("leaf_pair_capacity", static_cast<std::uint32_t>(capacity.leaf_pairs));
    program.set("pair_capacity", static_cast<std::uint32_t>(capacity.pairs));
    bind_one("Counts", counts);
    bind_both("SlotStarts", "slot_starts", slot_starts);
    bind_both("PairSlots", "pair_slots", slots);
    bind_both("NearPairs", "near_pairs", pairs);
    bind_both("PathEnds", "path_ends", path_ends);
    bind_both("Slacks", "slacks", slacks);
    bind_both("Motions", "motions", motions);
    bind_one("thicknesses", thicknesses_);
}

}  // namespace gelatin::gpu
