// As in advance_nodes_simd.cpp: a row or a tet a lane, compiled once for each instruction set.
#include "cpu/descent/volume_bounds.h"

#include <algorithm>

#include "model/for_each_index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/descent/volume_bounds.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/elasticity/elements-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// volume_stress round each node of a group. Nodes without a volume at rest have none.
void find_group_pressures(const VolumeTerm& term, const TetBlocks& blocks, std::size_t group,
                          const std::uint32_t* nodes, const float* volumes, float* pressures) {
    const Lanes d;
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        FloatLanes sum(0.0f);
        for (std::uint32_t b = blocks.neo_hookean_starts[group]; b < blocks.neo_hookean_starts[group + 1];
             ++b)
            sum += gather(d, volumes, &blocks.neo_hookean_tets[b][row]);
        for (std::uint32_t b = blocks.volume_starts[group]; b < blocks.volume_starts[group + 1]; ++b)
            sum += gather(d, volumes, &blocks.volume_tets[b][row]);
        HWY_ALIGN float rests[kLanes], moduli[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            const glm::vec2 rest = nodes[row + l] == kNoNode ? glm::vec2(0.0f) : term.nodes[nodes[row + l]];
            rests[l] = rest.x;
            moduli[l] = rest.y;
        }
        const FloatLanes rest = hn::Load(d, rests), none(0.0f);
        const FloatLanes ratio = FloatLanes(0.25f) * sum / rest;
        const FloatLanes stress = volume_stress(ratio, FloatLanes(hn::Load(d, moduli)));
        HWY_ALIGN float values[kLanes];
        hn::Store(select(rest > none, stress, none).v, d, values);
        for (std::size_t l = 0; l < kLanes; ++l) {
            if (nodes[row + l] != kNoNode) pressures[nodes[row + l]] = values[l];
        }
    }
}

void take_group_offsets(const TetBlocks& blocks, std::size_t group, const float* offsets,
                        TetOffsets& in_blocks) {
    const Lanes d;
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const auto of = [&](const BlockTets& tets) HWY_ATTR { return gather(d, offsets, &tets[row]); };
        const auto store = [&](FloatLanes values, BlockColumn& column)
                               HWY_ATTR { hn::StoreU(values.v, d, &column.values[row]); };
        for (std::uint32_t b = blocks.neo_hookean_starts[group]; b < blocks.neo_hookean_starts[group + 1];
             ++b)
            store(of(blocks.neo_hookean_tets[b]), in_blocks.neo_hookean[b]);
        for (std::uint32_t b = blocks.volume_starts[group]; b < blocks.volume_starts[group + 1]; ++b)
            store(FloatLanes(hn::LoadU(d, &blocks.inverse_six_volumes[b].values[row])) *
                      of(blocks.volume_tets[b]),
                  in_blocks.volumes[b]);
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {
namespace {

constexpr std::size_t kGroupsAtATime = 64;

}  // namespace

HWY_EXPORT(find_group_pressures);
HWY_EXPORT(take_group_offsets);

VolumeBounds::VolumeBounds(const Model& model, const TetBlocks& blocks)
    : volumes_(model.tets.size() + 1),
      pressures_(model.node_count()),
      offsets_(model.tets.size() + 1),
      in_blocks_(blocks) {}

void VolumeBounds::update(const Model& model, const TetBlocks& blocks, const DescentBatch& batch,
                          std::span<const std::uint32_t> nodes, std::span<const float> ratios) {
    const VolumeTerm& term = model.volume_term;
    const std::size_t first = batch.colors.front().first / kGroup, end = batch.colors.back().end() / kGroup;
    for_each_index(batch.tets, [&](std::uint32_t t) { volumes_[t] = ratios[t] * model.tet_rests[t].volume; });
    for_each_index(first, end, kGroupsAtATime, [&](std::size_t group) {
        HWY_DYNAMIC_DISPATCH(find_group_pressures)
        (term, blocks, group, &nodes[group * kGroup], volumes_.data(), pressures_.data());
    });
    for_each_index(batch.tets, [&](std::uint32_t t) {
        const glm::uvec4& tet = model.tets[t];
        const float sum = pressures_[tet.x] + pressures_[tet.y] + pressures_[tet.z] + pressures_[tet.w];
        offsets_[t] = 0.25f * sum * model.tet_rests[t].volume - term.tets[t] * volumes_[t];
    });
    for_each_index(first, end, kGroupsAtATime, [&](std::size_t group) {
        HWY_DYNAMIC_DISPATCH(take_group_offsets)(blocks, group, offsets_.data(), in_blocks_);
    });
}

}  // namespace gelatin::cpu
#endif
