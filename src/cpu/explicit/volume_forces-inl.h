// cpu::volume_stress_round and gather_volume_forces with one node in each lane. Compiled once for each
// instruction set, like simd_columns-inl.h.
#if defined(GELATIN_CPU_VOLUME_FORCES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_VOLUME_FORCES
#undef GELATIN_CPU_VOLUME_FORCES
#else
#define GELATIN_CPU_VOLUME_FORCES
#endif

#include "cpu/explicit/advance_nodes.h"
#include "cpu/simd_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

// Twice the area of the face opposite to each lane's node in its tet, outwards as seen from the node;
// `corner` is the face's first corner.
HWY_INLINE Vector3 opposite_area(Lanes d, const Vec4<float>* positions, const TetCorner* tets,
                                 Columns& corner) {
    corner = load_columns(d, [&](std::size_t l) { return &positions[tets[l].a].x; });
    const Columns b = load_columns(d, [&](std::size_t l) { return &positions[tets[l].b].x; });
    const Columns c = load_columns(d, [&](std::size_t l) { return &positions[tets[l].c].x; });
    return cross(subtract(b, corner), subtract(c, corner));
}

// Calls `work` with the tets of the rows first .. first + kLanes, one of each at a time.
template <class Work>
HWY_INLINE void for_rows(const TetCorners& corners, std::uint32_t first, const Work& work) {
    constexpr std::uint32_t kSlice = TetCorners::kSlice;
    const std::uint32_t end = corners.slice_starts[first / kSlice + 1];
    for (std::uint32_t e = corners.slice_starts[first / kSlice] + first % kSlice; e < end; e += kSlice)
        work(&corners.corners[e]);
}

HWY_INLINE Vector volume_stresses(Lanes d, const VolumeTerm& term, const Vec4<float>* positions,
                                  std::uint32_t first) {
    const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Columns at = load_columns(d, [&](std::size_t l) { return &positions[first + l].x; });
    Vector sum = zero;  // 24 times the volume
    for_rows(term.corners, first, [&](const TetCorner* tets) HWY_ATTR {
        Columns corner;
        const Vector3 area = opposite_area(d, positions, tets, corner);
        sum = hn::Add(sum, dot(subtract(at, corner), area));
    });
    Vector rest, kappa;
    hn::LoadInterleaved2(d, &term.nodes[first].x, rest, kappa);
    const Vector ratio = hn::Div(sum, hn::Mul(hn::Set(d, 24.0f), rest));
    const Vector u = hn::Sub(hn::IfThenElse(hn::Gt(rest, zero), ratio, one), one);
    const Vector left = hn::Max(hn::NegMulAdd(hn::Mul(hn::Set(d, 4.0f), u), u, one), zero);
    const Vector stress = hn::Mul(kappa, u);
    return hn::IfThenElse(hn::Lt(kappa, zero), hn::Mul(stress, hn::Mul(left, left)), stress);
}

// Adds the term's forces to those on the nodes first .. first + kLanes.
HWY_INLINE void add_volume_forces(Lanes d, const Pass<float>& pass, std::uint32_t first, Vector3& force) {
    const float* stresses = pass.volume_stresses;
    const Vector own = hn::LoadU(d, stresses + first), scale = hn::Set(d, -1.0f / 24.0f);
    for_rows(pass.model.volume_term.corners, first, [&](const TetCorner* tets) HWY_ATTR {
        HWY_ALIGN float others[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l)
            others[l] = stresses[tets[l].a] + stresses[tets[l].b] + stresses[tets[l].c];
        Columns corner;
        const Vector3 area = opposite_area(d, pass.positions, tets, corner);
        force = add_scaled(force, hn::Mul(scale, hn::Add(own, hn::Load(d, others))), area);
    });
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
