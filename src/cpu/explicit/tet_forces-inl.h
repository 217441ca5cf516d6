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
// cpu::gather_tet_forces.
HWY_INLINE void add_tet_forces(Lanes d, const Pass<float>& pass, const TetBlocks& blocks, std::uint32_t first,
                               const Columns& position, const Columns& velocity, Vec3Lanes& force) {
    const std::uint32_t group = first / kGroup, row = first % kGroup;
    const std::uint32_t begin = blocks.neo_hookean_starts[group], end = blocks.neo_hookean_starts[group + 1];
    StripLanes strip, rates;
    for (std::uint32_t b = begin; b < end; ++b) {
        const NeoHookeanBlock& block = blocks.neo_hookean[b];
        prefetch_block(&block);
        const Vector signs = hn::LoadU(d, &block.mu[row]);
        strip.step(d, &pass.positions[0].x, &block.nodes[row], position, signs);
        if (blocks.is_damped) rates.step(d, &pass.velocities[0].x, &block.nodes[row], velocity, signs);
        if (b < begin + TetBlocks::kEmptyBlocks) continue;
        const NeoHookeanLanes tet(d, block, row, strip);
        force += neo_hookean_force(tet.at_corner, tet.moduli);
        tet.add_openings(d, blocks.openings[b], row, force);
        if (!blocks.is_damped) continue;
        const FloatLanes damping_time =
            FloatLanes(0.25f) * (FloatLanes(velocity.w) + rates.w_a + rates.w_b + rates.w_c);
        if (hn::AllFalse(d, damping_time > FloatLanes(0.0f))) continue;
        force += viscous_force(tet.g, tet.f, tet.gradient_of(rates), tet.moduli, damping_time);
    }
}

// Twice the area of the face opposite to each lane's node in its tet, outwards as seen from the node;
// `corner` is the face's first corner.
HWY_INLINE Vec3Lanes opposite_area(Lanes d, const Vec4<float>* positions, const TetCorner* tets,
                                   Columns& corner) {
    corner = load_columns(d, [&](std::size_t l) { return &positions[tets[l].a].x; });
    const Columns b = load_columns(d, [&](std::size_t l) { return &positions[tets[l].b].x; });
    const Columns c = load_columns(d, [&](std::size_t l) { return &positions[tets[l].c].x; });
    return cross(difference(b, corner), difference(c, corner));
}

// Calls `work` with the tets of the rows first .. first + kLanes, one of each at a time.
template <class Work>
HWY_INLINE void for_rows(const TetCorners& corners, std::uint32_t first, const Work& work) {
    constexpr std::uint32_t kSlice = TetCorners::kSlice;
    const std::uint32_t end = corners.slice_starts[first / kSlice + 1];
    for (std::uint32_t e = corners.slice_starts[first / kSlice] + first % kSlice; e < end; e += kSlice)
        work(&corners.corners[e]);
}

// cpu::volume_stress_round of the nodes first .. first + kLanes.
HWY_INLINE FloatLanes volume_stresses(Lanes d, const VolumeTerm& term, const Vec4<float>* positions,
                                      std::uint32_t first) {
    const Columns at = load_columns(d, [&](std::size_t l) { return &positions[first + l].x; });
    FloatLanes sum(0.0f);  // 24 times the volume
    for_rows(term.corners, first, [&](const TetCorner* tets) HWY_ATTR {
        Columns corner;
        const Vec3Lanes area = opposite_area(d, positions, tets, corner);
        sum += dot(difference(at, corner), area);
    });
    Vector rest, kappa;
    hn::LoadInterleaved2(d, &term.nodes[first].x, rest, kappa);
    const FloatLanes ratio = sum / (FloatLanes(24.0f) * FloatLanes(rest));
    return volume_stress(select(FloatLanes(rest) > FloatLanes(0.0f), ratio, FloatLanes(1.0f)),
                         FloatLanes(kappa));
}

// As cpu::gather_volume_forces.
HWY_INLINE void add_volume_forces(Lanes d, const Pass<float>& pass, std::uint32_t first, Vec3Lanes& force) {
    const float* stresses = pass.volume_stresses;
    const FloatLanes own = hn::LoadU(d, stresses + first), scale(-1.0f / 24.0f);
    for_rows(pass.model.volume_term.corners, first, [&](const TetCorner* tets) HWY_ATTR {
        HWY_ALIGN float others[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l)
            others[l] = stresses[tets[l].a] + stresses[tets[l].b] + stresses[tets[l].c];
        Columns corner;
        const Vec3Lanes area = opposite_area(d, pass.positions, tets, corner);
        force = multiply_add(scale * (own + FloatLanes(hn::Load(d, others))), area, force);
    });
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
