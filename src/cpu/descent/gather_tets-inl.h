// What tets add to the terms of nodes, one node in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_GATHER_TETS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_GATHER_TETS
#undef GELATIN_CPU_GATHER_TETS
#else
#define GELATIN_CPU_GATHER_TETS
#endif

#include "cpu/descent/descend_groups.h"
#include "cpu/elasticity/tet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// Terms: TermLanes or ForceLanes.
template <class Terms>
HWY_INLINE void gather_neo_hookean_lanes(Lanes d, const DescentTets& tets, std::size_t group,
                                         std::uint32_t row, const std::uint32_t* shown, const Columns& self,
                                         const float* positions, Terms& terms) {
    const TetBlocks& blocks = tets.blocks;
    const std::uint32_t first = blocks.neo_hookean_starts[group], end = blocks.neo_hookean_starts[group + 1];
    if (first == end) return;
    const float* starts = &tets.starts[0].x;
    const Columns start = load_nodes(d, starts, &shown[row]);
    const FloatLanes damping_factor(0.25f * tets.inverse_step);
    StripLanes strip, before;
    for (std::uint32_t b = first; b < end; ++b) {
        const NeoHookeanBlock& block = blocks.neo_hookean[b];
        prefetch_block(&block);
        const LaneMask keeps = oldest_stays(d, hn::LoadU(d, &block.mu[row]));
        strip.step(d, positions, &block.nodes[row], self, keeps);
        if (blocks.is_damped) before.step(d, starts, &block.nodes[row], start, keeps);
        if (b < first + TetBlocks::kEmptyBlocks) continue;
        VolumeBound<FloatLanes> bound;
        if (!blocks.neo_hookean_moduli.empty())
            bound = {load(d, tets.offsets.neo_hookean[b].values, row),
                     load(d, blocks.neo_hookean_moduli[b].values, row)};
        const NeoHookeanLanes tet(d, block, row, strip);
        add_neo_hookean(tet.at_corner, tet.moduli, bound, terms);
        tet.add_openings(d, blocks.openings[b], row, terms.force);
        if (!blocks.is_damped) continue;
        const FloatLanes damping = damping_factor * (FloatLanes(start.w) + before.w.sum());
        if (hn::AllFalse(d, damping > FloatLanes(0.0f))) continue;
        add_viscosity(tet.g, tet.f, tet.gradient_of(before), tet.moduli, damping, terms);
    }
}

template <class Terms>
HWY_INLINE void gather_volume_lanes(Lanes d, const DescentTets& tets, std::size_t group, std::uint32_t row,
                                    const Columns& self, const float* positions, Terms& terms) {
    const TetBlocks& blocks = tets.blocks;
    const std::uint32_t first = blocks.volume_starts[group], end = blocks.volume_starts[group + 1];
    StripLanes strip;
    for (std::uint32_t b = first; b < end; ++b) {
        const VolumeBlock& block = blocks.volumes[b];
        prefetch_block(&block);
        const Vector modulus = hn::LoadU(d, &block.modulus[row]);
        strip.step(d, positions, &block.nodes[row], self, oldest_stays(d, modulus));
        if (b < first + TetBlocks::kEmptyBlocks) continue;
        // By 6 V J in place of J: its slope is the area.
        const Vec3Lanes area = strip.area();
        const VolumeBound<FloatLanes> bound{load(d, tets.offsets.volumes[b].values, row), hn::Abs(modulus)};
        add_tet_volume(area, -dot(strip.a, area), bound, terms);
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
