// One tet in each lane; compiled once for each instruction set.
#include "cpu/elasticity/volume_ratios.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/elasticity/volume_ratios.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/elasticity/elements-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// For kLanes tets.
HWY_INLINE Vector ratios_of(Lanes d, const glm::uvec4* tets, const TetRest* rests,
                            const glm::vec4* positions) {
    const auto corner = [&](int k) HWY_ATTR {
        return load_columns(d, [&](std::size_t l) { return &positions[tets[l][k]].x; });
    };
    HWY_ALIGN float volumes[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) volumes[l] = rests[l].volume;
    const Columns a = corner(0);
    const Vec3Lanes ab = difference(corner(1), a), ac = difference(corner(2), a),
                    ad = difference(corner(3), a);
    const FloatLanes inverse = FloatLanes(1.0f / 6.0f) / FloatLanes(hn::Load(d, volumes));
    return dot(volume_slope(ab, ac, inverse), ad).v;
}

bool are_within(float least, float most, const Model& model, const Range& tets, const glm::vec4* positions,
                float* ratios) {
    const Lanes d;
    const Vector low = hn::Set(d, least), high = hn::Set(d, most);
    const auto within = [&](Vector v)
                            HWY_ATTR { return hn::AllTrue(d, hn::And(hn::Gt(v, low), hn::Lt(v, high))); };
    bool all = true;
    std::size_t t = tets.first;
    for (; t + kLanes <= tets.end(); t += kLanes) {
        const Vector ratio = ratios_of(d, &model.tets[t], &model.tet_rests[t], positions);
        all = within(ratio) && all;
        if (ratios != nullptr) hn::StoreU(ratio, d, ratios + (t - tets.first));
    }
    if (t == tets.end()) return all;
    // The last tets, padded with one of them.
    const std::size_t count = tets.end() - t;
    std::array<glm::uvec4, kLanes> last;
    std::array<TetRest, kLanes> rests;
    for (std::size_t l = 0; l < kLanes; ++l) {
        last[l] = model.tets[t + std::min(l, count - 1)];
        rests[l] = model.tet_rests[t + std::min(l, count - 1)];
    }
    const Vector ratio = ratios_of(d, last.data(), rests.data(), positions);
    if (ratios != nullptr) {
        HWY_ALIGN float values[kLanes];
        hn::Store(ratio, d, values);
        std::copy_n(values, count, ratios + (t - tets.first));
    }
    return within(ratio) && all;
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

bool volumes_are_within(double least, double most, const Model& model, const Range& tets,
                        const glm::dvec4* positions, double* ratios) {
    bool all = true;
    for (std::uint32_t t = tets.first; t < tets.end(); ++t) {
        const glm::uvec4& corners = model.tets[t];
        const glm::dvec3 a(positions[corners.x]);
        const glm::dvec3 ab = glm::dvec3(positions[corners.y]) - a, ac = glm::dvec3(positions[corners.z]) - a,
                         ad = glm::dvec3(positions[corners.w]) - a;
        const double ratio =
            glm::dot(volume_slope(ab, ac, inverse_six_volumes<double>(model.tet_rests[t])), ad);
        all = all && ratio > least && ratio < most;
        if (ratios != nullptr) ratios[t - tets.first] = ratio;
    }
    return all;
}

}  // namespace gelatin::cpu
#endif
