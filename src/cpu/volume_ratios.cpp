// A tet a lane, compiled once for each instruction set.
#include "cpu/volume_ratios.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/volume_ratios.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// det (b - a, c - a, e - a)
HWY_INLINE Vector six_volumes(const Columns& a, const Columns& b, const Columns& c, const Columns& e) {
    const Vector ux = hn::Sub(b.x, a.x), uy = hn::Sub(b.y, a.y), uz = hn::Sub(b.z, a.z);
    const Vector vx = hn::Sub(c.x, a.x), vy = hn::Sub(c.y, a.y), vz = hn::Sub(c.z, a.z);
    const Vector wx = hn::Sub(e.x, a.x), wy = hn::Sub(e.y, a.y), wz = hn::Sub(e.z, a.z);
    const Vector x = hn::NegMulAdd(uz, vy, hn::Mul(uy, vz));
    const Vector y = hn::NegMulAdd(ux, vz, hn::Mul(uz, vx));
    const Vector z = hn::NegMulAdd(uy, vx, hn::Mul(ux, vy));
    return hn::MulAdd(x, wx, hn::MulAdd(y, wy, hn::Mul(z, wz)));
}

bool are_within(float least, float most, const Model& model, const Range& tets, const glm::vec4* positions,
                float* ratios) {
    const Lanes d;
    bool all = true;
    for (std::size_t first = tets.first; first < tets.end(); first += kLanes) {
        const std::size_t count = std::min(kLanes, tets.end() - first);
        const auto tet = [&](std::size_t l) { return first + std::min(l, count - 1); };  // the last one again
        const auto corner = [&](int k) HWY_ATTR {
            return load_columns(d, [&](std::size_t l) { return &positions[model.tets[tet(l)][k]].x; });
        };
        HWY_ALIGN float values[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) values[l] = model.tet_rests[tet(l)].volume;
        const Vector rest = hn::Mul(hn::Set(d, 6.0f), hn::Load(d, values));
        const Vector ratio = hn::Div(six_volumes(corner(0), corner(1), corner(2), corner(3)), rest);
        all = all && hn::AllTrue(d, hn::And(hn::Gt(ratio, hn::Set(d, least)), hn::Lt(ratio, hn::Set(d, most))));
        if (ratios == nullptr) continue;
        hn::Store(ratio, d, values);
        std::copy_n(values, count, ratios + first);
    }
    return all;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(are_within);

bool volumes_are_within(float least, float most, const Model& model, const Range& tets,
                        const glm::vec4* positions, float* ratios) {
    return HWY_DYNAMIC_DISPATCH(are_within)(least, most, model, tets, positions, ratios);
}

}  // namespace gelatin::cpu
#endif
