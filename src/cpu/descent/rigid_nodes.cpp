// Nodes a lane each, in double where they are summed up; compiled once for each instruction set.
#include "cpu/descent/rigid_nodes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/descent/rigid_nodes.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, kLanes>;
using DoubleVector = hn::Vec<Doubles>;

HWY_INLINE double sum_of(DoubleVector v) {
    return hn::GetLane(hn::SumOfLanes(Doubles(), v));
}

// RigidSums, a lane each.
struct SumLanes {
    DoubleVector stiffness, arm[3], square[3], product[3], force[3], moment[3];

    HWY_INLINE void add(const DoubleVector* r, DoubleVector k, const DoubleVector* f) {
        stiffness = hn::Add(stiffness, k);
        for (int c = 0; c < 3; ++c) {
            const int a = (c + 1) % 3, b = (c + 2) % 3;
            const DoubleVector pulled = hn::Mul(k, r[c]);
            arm[c] = hn::Add(arm[c], pulled);
            square[c] = hn::MulAdd(pulled, r[c], square[c]);
            product[b] = hn::MulAdd(pulled, r[a], product[b]);
            force[c] = hn::Add(force[c], f[c]);
            moment[c] = hn::Add(moment[c], hn::MulSub(r[a], f[b], hn::Mul(r[b], f[a])));
        }
    }

    HWY_INLINE RigidSums sum() const {
        const auto sums = [](const DoubleVector* v)
                              HWY_ATTR { return glm::dvec3(sum_of(v[0]), sum_of(v[1]), sum_of(v[2])); };
        return {sum_of(stiffness), sums(arm), {sums(square), sums(product)}, sums(force), sums(moment)};
    }
};

HWY_INLINE SumLanes no_sums() {
    const DoubleVector zero = hn::Zero(Doubles());
    return {zero,
            {zero, zero, zero},
            {zero, zero, zero},
            {zero, zero, zero},
            {zero, zero, zero},
            {zero, zero, zero}};
}

RigidSums sum_nodes(std::span<const glm::vec4> positions, std::span<const glm::vec4> targets,
                    const glm::vec3& origin) {
    const Lanes d;
    const Doubles dd;
    const hn::Rebind<float, Doubles> df;  // as many floats as doubles at a time
    const Vector ox = hn::Set(d, origin.x), oy = hn::Set(d, origin.y), oz = hn::Set(d, origin.z);
    SumLanes lanes = no_sums();
    std::size_t n = 0;
    for (; n + kLanes <= positions.size(); n += kLanes) {
        const Columns p = load_columns(d, [&](std::size_t l) { return &positions[n + l].x; });
        const Columns y = load_columns(d, [&](std::size_t l) { return &targets[n + l].x; });
        HWY_ALIGN float r[3][kLanes], displacement[3][kLanes], k[kLanes];
        hn::Store(hn::Sub(p.x, ox), d, r[0]);
        hn::Store(hn::Sub(p.y, oy), d, r[1]);
        hn::Store(hn::Sub(p.z, oz), d, r[2]);
        hn::Store(hn::Sub(y.x, p.x), d, displacement[0]);
        hn::Store(hn::Sub(y.y, p.y), d, displacement[1]);
        hn::Store(hn::Sub(y.z, p.z), d, displacement[2]);
        hn::Store(y.w, d, k);
        for (std::size_t l = 0; l < kLanes; l += hn::MaxLanes(dd)) {
            const auto load = [&](const float* from)
                                  HWY_ATTR { return hn::PromoteTo(dd, hn::Load(df, from + l)); };
            const DoubleVector stiffness = load(k);
            const DoubleVector arms[3] = {load(r[0]), load(r[1]), load(r[2])};
            const DoubleVector forces[3] = {hn::Mul(stiffness, load(displacement[0])),
                                            hn::Mul(stiffness, load(displacement[1])),
                                            hn::Mul(stiffness, load(displacement[2]))};
            lanes.add(arms, stiffness, forces);
        }
    }
    RigidSums sums = lanes.sum();
    for (; n < positions.size(); ++n) {
        const auto stiffness = static_cast<double>(targets[n].w);
        sums.add(glm::dvec3(glm::vec3(positions[n]) - origin), stiffness,
                 stiffness * glm::dvec3(targets[n] - positions[n]));
    }
    return sums;
}

// x + (translation + (rotation - 1) (x - center)): what a step adds is small, and rounded as such.
void move_nodes(const RigidMotion& motion, std::span<glm::vec4> positions) {
    const Lanes d;
    const glm::mat3 rotated(motion.rotation - glm::dmat3(1.0));
    const glm::vec3 center(motion.center), translation(motion.translation);
    std::size_t n = 0;
    for (; n + kLanes <= positions.size(); n += kLanes) {
        const Columns p = load_columns(d, [&](std::size_t l) { return &positions[n + l].x; });
        const Vector x = hn::Sub(p.x, hn::Set(d, center.x)), y = hn::Sub(p.y, hn::Set(d, center.y)),
                     z = hn::Sub(p.z, hn::Set(d, center.z));
        const auto row = [&](int c) HWY_ATTR {
            return hn::MulAdd(
                hn::Set(d, rotated[0][c]), x,
                hn::MulAdd(hn::Set(d, rotated[1][c]), y,
                           hn::MulAdd(hn::Set(d, rotated[2][c]), z, hn::Set(d, translation[c]))));
        };
        hn::StoreInterleaved4(hn::Add(p.x, row(0)), hn::Add(p.y, row(1)), hn::Add(p.z, row(2)), p.w, d,
                              &positions[n].x);
    }
    for (; n < positions.size(); ++n)
        positions[n] += glm::vec4(translation + rotated * (glm::vec3(positions[n]) - center), 0.0f);
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(sum_nodes);
HWY_EXPORT(move_nodes);

RigidSums sum_rigid_nodes(std::span<const glm::vec4> positions, std::span<const glm::vec4> targets,
                          const glm::dvec3& origin) {
    return HWY_DYNAMIC_DISPATCH(sum_nodes)(positions, targets, glm::vec3(origin));
}

RigidSums sum_rigid_nodes(std::span<const glm::dvec4> positions, std::span<const glm::dvec4> targets,
                          const glm::dvec3& origin) {
    RigidSums sums;
    for (std::size_t n = 0; n < positions.size(); ++n) {
        const glm::dvec3 position(positions[n]);
        sums.add(position - origin, targets[n].w, targets[n].w * (glm::dvec3(targets[n]) - position));
    }
    return sums;
}

void move_rigid_nodes(const RigidMotion& motion, std::span<glm::vec4> positions) {
    HWY_DYNAMIC_DISPATCH(move_nodes)(motion, positions);
}

void move_rigid_nodes(const RigidMotion& motion, std::span<glm::dvec4> positions) {
    for (glm::dvec4& p : positions) p = glm::dvec4(motion.move(glm::dvec3(p)), p.w);
}

}  // namespace gelatin::cpu
#endif
