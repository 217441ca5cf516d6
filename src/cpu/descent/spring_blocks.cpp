// As in advance_nodes_simd.cpp: a row a lane, compiled once for each instruction set.
#include "cpu/descent/spring_blocks.h"

#include <algorithm>

#include "model/for_each_index.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/descent/spring_blocks.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/elasticity/elements-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

void damp_group(const SpringBlocks& springs, std::uint32_t group, const std::uint32_t* nodes,
                const glm::vec4* starts, float inverse_step, SpringBlocks& damped) {
    const Lanes d;
    const FloatLanes factor(0.5f * inverse_step);
    const std::array<std::uint32_t, kGroup> shown = shown_nodes(nodes);
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const Columns self = load_nodes(d, &starts[0].x, &shown[row]);
        for (std::uint32_t b = springs.starts[group]; b < springs.starts[group + 1]; ++b) {
            const SpringBlock& block = springs.blocks[b];
            const Columns other = load_nodes(d, &starts[0].x, &block.nodes[row]);
            const Vec3Lanes apart = difference(other, self);
            const SpringLaw<FloatLanes> spring{hn::LoadU(d, &block.rest_lengths[row]),
                                               hn::LoadU(d, &block.stiffnesses[row])};
            const SpringLaw<FloatLanes> both = damped_spring(
                spring, square_root(dot(apart, apart)), factor * (FloatLanes(self.w) + FloatLanes(other.w)));
            hn::StoreU(both.rest_length.v, d, &damped.blocks[b].rest_lengths[row]);
            hn::StoreU(both.stiffness.v, d, &damped.blocks[b].stiffnesses[row]);
        }
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(damp_group);

void damp_springs(const SpringBlocks& springs, std::span<const std::uint32_t> nodes, const glm::vec4* starts,
                  float inverse_step, SpringBlocks& damped) {
    for_each_index(springs.starts.size() - 1, [&](std::size_t g) {
        if (is_empty_group(&nodes[g * kGroup])) return;
        HWY_DYNAMIC_DISPATCH(damp_group)
        (springs, static_cast<std::uint32_t>(g), &nodes[g * kGroup], starts, inverse_step, damped);
    });
}

SpringBlocks make_spring_blocks(const DescentRows& rows) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = rows.springs;
    SpringBlocks result;
    for (std::uint32_t first = 0; first < rows.nodes.size(); first += kGroup) {
        result.starts.push_back(static_cast<std::uint32_t>(result.blocks.size()));
        const std::uint32_t slice = first / kSlice;
        for (std::uint32_t p = springs.slice_starts[slice] + first % kSlice;
             p < springs.slice_starts[slice + 1]; p += kSlice) {
            SpringBlock one{}, two{};
            for (std::uint32_t r = 0; r < kGroup; ++r) {
                const HalfSpringPair& pair = springs.pairs[p + r];
                one.nodes[r] = pair.node_0;
                one.rest_lengths[r] = pair.rest_length_0;
                one.stiffnesses[r] = springs.stiffness[p + r].x;
                two.nodes[r] = pair.node_1;
                two.rest_lengths[r] = pair.rest_length_1;
                two.stiffnesses[r] = springs.stiffness[p + r].y;
            }
            result.blocks.push_back(one);
            result.blocks.push_back(two);
        }
        // Shorter than the slice's longest row.
        const auto pulls = [](float stiffness) { return stiffness > 0.0f; };
        while (result.blocks.size() > result.starts.back() &&
               std::none_of(result.blocks.back().stiffnesses.begin(), result.blocks.back().stiffnesses.end(),
                            pulls))
            result.blocks.pop_back();
    }
    result.starts.push_back(static_cast<std::uint32_t>(result.blocks.size()));
    return result;
}

}  // namespace gelatin::cpu
#endif
