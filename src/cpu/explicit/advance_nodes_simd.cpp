// Eight nodes at a time, one in each lane; compiled once for each instruction set and selected at run time by
// Highway. The lanes are neighbours in a slice of HalfSprings. So springs are read in order and only the
// other ends are gathered: as rows (one 16-byte load for each node) that are transposed to columns in
// registers. Large models are limited by memory: strides within slices and gathers defeat the hardware's
// prefetching, so it is done explicitly, one slice and one small object ahead (with it, a step of 10 times as
// many springs takes 10 times as long, without it 20 times).
#include "cpu/explicit/advance_nodes.h"

#include "cpu/elasticity/volume_term.h"
#include "cpu/explicit/gather_forces.h"
#include "cpu/explicit/integrate_node.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/explicit/advance_nodes_simd.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/explicit/tet_forces-inl.h"
#include "cpu/explicit/volume_forces-inl.h"
#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// Below SSSE3 SIMD gains nothing.
void advance_slices(const Pass<float>& pass, Range slices) {
    advance_nodes<float>(pass, slices);
}

void find_stresses(const Model& model, const Nodes<float>& at, std::span<float> stresses, Range slices) {
    find_volume_stresses<float>(model, at, stresses, slices);
}

#else

struct Node {
    Columns position, velocity;
};

// cpu::spring_force for each lane, added to `force`.
HWY_INLINE void add_spring_force(Lanes d, const Node& a, const Node& b, Vector rest_length, Vector stiffness,
                                 Vector3& force) {
    const Vector dx = hn::Sub(b.position.x, a.position.x);
    const Vector dy = hn::Sub(b.position.y, a.position.y);
    const Vector dz = hn::Sub(b.position.z, a.position.z);
    const Vector squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const Vector length = hn::Sqrt(hn::Max(squared, hn::Set(d, 1e-30f)));
    const Vector inverse_length = hn::Div(hn::Set(d, 1.0f), length);

    const Vector vx = hn::Sub(b.velocity.x, a.velocity.x);
    const Vector vy = hn::Sub(b.velocity.y, a.velocity.y);
    const Vector vz = hn::Sub(b.velocity.z, a.velocity.z);
    const Vector rate = hn::Mul(hn::MulAdd(dx, vx, hn::MulAdd(dy, vy, hn::Mul(dz, vz))), inverse_length);
    const Vector damping_time = hn::Mul(hn::Set(d, 0.5f), hn::Add(a.velocity.w, b.velocity.w));

    const Vector stretch = hn::MulAdd(damping_time, rate, hn::Sub(length, rest_length));
    const Vector scale = hn::Mul(hn::Mul(stiffness, stretch), inverse_length);
    force.x = hn::MulAdd(scale, dx, force.x);
    force.y = hn::MulAdd(scale, dy, force.y);
    force.z = hn::MulAdd(scale, dz, force.z);
}

// Forces on the nodes first .. first + kLanes.
HWY_INLINE Vector3 gather_lanes(Lanes d, const Pass<float>& pass, std::uint32_t first) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const float* positions = &pass.positions[0].x;
    const float* velocities = &pass.velocities[0].x;
    const auto load_node = [&](const auto& index) HWY_ATTR {
        return Node{load_columns(d, [&](std::size_t l) { return positions + 4 * std::size_t(index(l)); }),
                    load_columns(d, [&](std::size_t l) { return velocities + 4 * std::size_t(index(l)); })};
    };
    const Node self = load_node([&](std::size_t l) { return first + l; });
    const HalfSprings& springs = pass.model.half_springs;
    Vector3 force{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    const std::uint32_t end = springs.slice_starts[first / kSlice + 1];
    const std::uint32_t slice_length = end - springs.slice_starts[first / kSlice];
    for (std::uint32_t p = springs.slice_starts[first / kSlice] + first % kSlice; p < end; p += kSlice) {
        const HalfSpringPair* pairs = &springs.pairs[p];
        prefetch_lanes(pairs + slice_length);
        prefetch_lanes(&springs.stiffness[p] + slice_length);
        const Columns columns =
            load_columns(d, [&](std::size_t l) { return reinterpret_cast<const float*>(pairs + l); });
        Vector stiffness_0, stiffness_1;
        hn::LoadInterleaved2(d, &springs.stiffness[p].x, stiffness_0, stiffness_1);
        const Node other_0 = load_node([&](std::size_t l) { return pairs[l].node_0; });
        add_spring_force(d, self, other_0, columns.y, stiffness_0, force);
        const Node other_1 = load_node([&](std::size_t l) { return pairs[l].node_1; });
        add_spring_force(d, self, other_1, columns.w, stiffness_1, force);
    }
    return force;
}

void advance_slices(const Pass<float>& pass, Range slices) {
    const Lanes d;
    const std::uint32_t end = std::min(slices.end() * HalfSprings::kSlice, pass.model.node_count());
    std::uint32_t n = slices.first * HalfSprings::kSlice;
    for (; n + kLanes <= end; n += kLanes) {
        prefetch_lanes(pass.positions + n + kNodesAhead);
        prefetch_lanes(pass.velocities + n + kNodesAhead);
        Vector3 force = gather_lanes(d, pass, n);
        if (!pass.model.neo_hookean_tets.empty()) add_tet_forces(d, pass, n, force);
        if (pass.volume_stresses != nullptr) add_volume_forces(d, pass, n, force);
        HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
        hn::Store(force.x, d, x);
        hn::Store(force.y, d, y);
        hn::Store(force.z, d, z);
        for (std::uint32_t l = 0; l < kLanes; ++l) integrate_node(pass, n + l, {x[l], y[l], z[l]});
    }
    for (; n < end; ++n) integrate_node(pass, n, gather_forces(pass, n));
}

void find_stresses(const Model& model, const Nodes<float>& at, std::span<float> stresses, Range slices) {
    const Lanes d;
    const Vec4<float>* positions = at.positions.data();
    const std::uint32_t end = std::min(slices.end() * HalfSprings::kSlice, model.node_count());
    std::uint32_t n = slices.first * HalfSprings::kSlice;
    for (; n + kLanes <= end; n += kLanes)
        hn::StoreU(volume_stresses(d, model.volume_term, positions, n), d, &stresses[n]);
    for (; n < end; ++n) stresses[n] = volume_stress_round(model.volume_term, n, positions);
}

#endif

const char* target_name() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(advance_slices);
HWY_EXPORT(find_stresses);
HWY_EXPORT(target_name);

void advance_nodes_simd(const Pass<float>& pass, Range slices) {
    HWY_DYNAMIC_DISPATCH(advance_slices)(pass, slices);
}

void find_volume_stresses_simd(const Model& model, const Nodes<float>& at, std::span<float> stresses,
                               Range slices) {
    HWY_DYNAMIC_DISPATCH(find_stresses)(model, at, stresses, slices);
}

const char* simd_target() {
    return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace gelatin::cpu
#endif
