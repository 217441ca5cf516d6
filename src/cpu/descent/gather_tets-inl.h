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

HWY_INLINE VolumeBound<FloatLanes> load_bounds(Lanes d, std::span<const glm::vec4> bounds,
                                               const std::uint32_t* tets) {
    if (bounds.empty()) return {};
    const Columns columns = load_nodes(d, &bounds[0].x, tets);
    return {columns.x, columns.y};
}

HWY_INLINE void gather_neo_hookean_lanes(Lanes d, const DescentTets& tets, std::size_t group,
                                         std::uint32_t row, const std::uint32_t* shown, const Columns& self,
                                         const float* positions, TermLanes& terms) {
    const std::uint32_t first = tets.blocks.neo_hookean_starts[group],
                        end = tets.blocks.neo_hookean_starts[group + 1];
    if (first == end) return;
    const Columns start = load_nodes(d, &tets.starts[0].x, &shown[row]);
    for (std::uint32_t b = first; b < end; ++b) {
        const NeoHookeanBlock& block = tets.blocks.neo_hookean[b];
        prefetch_block(&block);
        const NeoHookeanLanes tet(d, block, row, EdgeLanes(d, positions, block, row, self));
        add_neo_hookean(tet.at_corner, tet.moduli, load_bounds(d, tets.bounds, &block.tets[row]), terms);
        tet.add_openings(d, tets.blocks.openings[b], row, terms.force);
        if (!tets.blocks.is_damped) continue;
        const EdgeLanes before(d, &tets.starts[0].x, block, row, start);
        const FloatLanes damping = FloatLanes(0.25f * tets.inverse_step) * before.sum_of_w;
        if (hn::AllFalse(d, damping > FloatLanes(0.0f))) continue;
        add_viscosity(tet.g, tet.f, tet.gradient_of(before), tet.moduli, damping, terms);
    }
}

HWY_INLINE void gather_volume_lanes(Lanes d, const DescentTets& tets, std::size_t group, std::uint32_t row,
                                    const Columns& self, const float* positions, TermLanes& terms) {
    for (std::uint32_t b = tets.blocks.volume_starts[group]; b < tets.blocks.volume_starts[group + 1]; ++b) {
        const VolumeBlock& block = tets.blocks.volumes[b];
        prefetch_block(&block);
        const EdgeLanes edges(d, positions, block, row, self);
        const Vec3Lanes slope = load(d, block.inverse_six_volumes, row) * edges.area();
        add_tet_volume(slope, -dot(edges.a, slope), load_bounds(d, tets.bounds, &block.tets[row]), terms);
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
