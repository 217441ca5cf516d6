// The forces of tets for explicit schemes, with a node in each lane. Compiled once for each instruction set,
// like simd_columns-inl.h.
#if defined(GELATIN_CPU_TET_FORCES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_TET_FORCES
#undef GELATIN_CPU_TET_FORCES
#else
#define GELATIN_CPU_TET_FORCES
#endif

#include "cpu/elasticity/tet_lanes-inl.h"
#include "cpu/explicit/advance_nodes.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

// Adds the forces of neo-Hookean tets to those on the nodes first .. first + kLanes, as
// cpu::gather_tet_forces, and for their nodes those of the volume term, as cpu::gather_volume_forces.
HWY_INLINE void add_tet_forces(Lanes d, const Pass<float>& pass, const TetBlocks& blocks, std::uint32_t first,
                               const Columns& position, const Columns& velocity, Vec3Lanes& force) {
    const std::uint32_t group = first / kGroup, row = first % kGroup;
    const std::uint32_t begin = blocks.neo_hookean_starts[group], end = blocks.neo_hookean_starts[group + 1];
    if (begin == end) return;
    const float* stresses = pass.volume_stresses;
    const FloatLanes own = stresses == nullptr ? FloatLanes(0.0f) : hn::LoadU(d, stresses + first);
    StripLanes strip, rates;
    NumberStrip others;
    for (std::uint32_t b = begin; b < end; ++b) {
        const NeoHookeanBlock& block = blocks.neo_hookean[b];
        prefetch_block(&block);
        const LaneMask keeps = oldest_stays(d, hn::LoadU(d, &block.mu[row]));
        strip.step(d, &pass.positions[0].x, &block.nodes[row], position, keeps);
        if (blocks.is_damped) rates.step(d, &pass.velocities[0].x, &block.nodes[row], velocity, keeps);
        if (stresses != nullptr) others.step(gather(d, stresses, &block.nodes[row]), keeps);
        if (b < begin + TetBlocks::kEmptyBlocks) continue;
        const NeoHookeanLanes tet(d, block, row, strip);
        force += neo_hookean_force(tet.at_corner, tet.moduli);
        if (stresses != nullptr)
            force =
                multiply_add(FloatLanes(-0.25f) * (own + others.sum()), tet.volume_slope(d, strip), force);
        tet.add_openings(d, blocks.openings[b], row, force);
        if (!blocks.is_damped) continue;
        const FloatLanes damping_time = FloatLanes(0.25f) * (FloatLanes(velocity.w) + rates.w.sum());
        if (hn::AllFalse(d, damping_time > FloatLanes(0.0f))) continue;
        force += viscous_force(tet.g, tet.f, tet.gradient_of(rates), tet.moduli, damping_time);
    }
}

// Calls visit(block, keeps, area, strip) for each step along the strips of the nodes first .. first + kLanes,
// with twice the area of the face opposite to them, away from them; 0 where no tet is complete.
template <class Visit>
HWY_INLINE void for_each_volume(Lanes d, const TetBlocks& blocks, const Vec4<float>* positions,
                                std::uint32_t first, const Columns& self, const Visit& visit) {
    const std::uint32_t group = first / kGroup, row = first % kGroup;
    StripLanes strip;
    for (std::uint32_t b = blocks.volume_starts[group]; b < blocks.volume_starts[group + 1]; ++b) {
        const VolumeBlock& block = blocks.volumes[b];
        prefetch_block(&block);
        const LaneMask keeps = oldest_stays(d, hn::LoadU(d, &block.modulus[row]));
        strip.step(d, &positions[0].x, &block.nodes[row], self, keeps);
        const Vector inverse = hn::LoadU(d, &blocks.inverse_six_volumes[b].values[row]);
        const FloatLanes side =
            hn::IfThenElseZero(hn::Ne(inverse, hn::Zero(d)), hn::CopySign(hn::Set(d, 1.0f), inverse));
        visit(block, keeps, side * strip.area(), strip);
    }
}

// cpu::volume_stress_round of the nodes first .. first + kLanes.
HWY_INLINE FloatLanes volume_stresses(Lanes d, const VolumeTerm& term, const TetBlocks& blocks,
                                      const Vec4<float>* positions, std::uint32_t first) {
    const Columns self = load_columns(d, [&](std::size_t l) { return &positions[first + l].x; });
    FloatLanes sum(0.0f);  // 24 times the volume
    for_each_volume(d, blocks, positions, first, self,
                    [&](const VolumeBlock&, LaneMask, const Vec3Lanes& area, const StripLanes& strip)
                        HWY_ATTR { sum = sum - dot(strip.a, area); });
    Vector rest, kappa;
    hn::LoadInterleaved2(d, &term.nodes[first].x, rest, kappa);
    const FloatLanes ratio = sum / (FloatLanes(24.0f) * FloatLanes(rest));
    return volume_stress(select(FloatLanes(rest) > FloatLanes(0.0f), ratio, FloatLanes(1.0f)),
                         FloatLanes(kappa));
}

// Nodes without neo-Hookean tets, of which a node's first is complete after the empty blocks.
HWY_INLINE LaneMask has_springs(Lanes d, const TetBlocks& blocks, std::uint32_t first) {
    const std::uint32_t group = first / kGroup, row = first % kGroup;
    const std::uint32_t begin = blocks.neo_hookean_starts[group];
    const Vector zero = hn::Zero(d);
    if (begin == blocks.neo_hookean_starts[group + 1]) return hn::Eq(zero, zero);
    return hn::Eq(hn::LoadU(d, &blocks.neo_hookean[begin + TetBlocks::kEmptyBlocks].mu[row]), zero);
}

// As cpu::gather_volume_forces, for nodes of springs.
HWY_INLINE void add_volume_forces(Lanes d, const Pass<float>& pass, const TetBlocks& blocks,
                                  std::uint32_t first, const Columns& position, Vec3Lanes& force) {
    const LaneMask counts = has_springs(d, blocks, first);
    if (hn::AllFalse(d, counts)) return;
    const float* stresses = pass.volume_stresses;
    const FloatLanes own = hn::LoadU(d, stresses + first);
    const FloatLanes scale = hn::IfThenElseZero(counts, hn::Set(d, -1.0f / 24.0f));
    NumberStrip others;
    const std::uint32_t row = first % kGroup;
    for_each_volume(d, blocks, pass.positions, first, position,
                    [&](const VolumeBlock& block, LaneMask keeps, const Vec3Lanes& area, const StripLanes&)
                        HWY_ATTR {
                            others.step(gather(d, stresses, &block.nodes[row]), keeps);
                            force = multiply_add(scale * (own + others.sum()), area, force);
                        });
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
