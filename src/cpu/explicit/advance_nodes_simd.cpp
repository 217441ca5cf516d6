// Eight nodes at a time, one in each lane; compiled once for each instruction set and selected at run time by
// Highway. The lanes are neighbours in a slice of HalfSprings. So springs are read in order and only the
// other ends are gathered: as rows (one 16-byte load for each node) that are transposed to columns in
// registers. Large models are limited by memory: strides within slices and gathers defeat the hardware's
// prefetching, so it is done explicitly, one slice and one small object ahead (with it, a step of 10 times as
// many springs takes 10 times as long, without it 20 times).
#include "cpu/explicit/advance_nodes.h"

#include <numeric>

#include "cpu/elasticity/volume_term.h"
#include "cpu/explicit/gather_forces.h"
#include "cpu/explicit/integrate_node.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/explicit/advance_nodes_simd.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/explicit/tet_forces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

// Below SSSE3 SIMD gains nothing.
void advance_slices(const Pass<float>& pass, const TetBlocks& tets, Range slices) {
    (void)tets;
    advance_nodes<float>(pass, slices);
}

void find_stresses(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                   std::span<float> stresses, Range slices) {
    (void)tets;
    find_volume_stresses<float>(model, at, stresses, slices);
}

#else

struct NodeLanes {
    Columns position, velocity;
};

HWY_INLINE void add_spring_force(const NodeLanes& self, const NodeLanes& other, Vector rest_length,
                                 Vector stiffness, Vec3Lanes& force) {
    const Vec3Lanes apart = difference(other.position, self.position);
    const FloatLanes damping_times = FloatLanes(self.velocity.w) + FloatLanes(other.velocity.w);
    const FloatLanes pull =
        spring_pull<FloatLanes>(apart, difference(other.velocity, self.velocity), {rest_length, stiffness},
                                FloatLanes(0.5f) * damping_times);
    force = multiply_add(pull, apart, force);
}

// Forces on the nodes first .. first + kLanes.
HWY_INLINE Vec3Lanes gather_lanes(Lanes d, const Pass<float>& pass, const TetBlocks& tets,
                                  std::uint32_t first) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const float* positions = &pass.positions[0].x;
    const float* velocities = &pass.velocities[0].x;
    const auto load_node = [&](const auto& index) HWY_ATTR {
        return NodeLanes{
            load_columns(d, [&](std::size_t l) { return positions + 4 * std::size_t(index(l)); }),
            load_columns(d, [&](std::size_t l) { return velocities + 4 * std::size_t(index(l)); })};
    };
    const NodeLanes self = load_node([&](std::size_t l) { return first + l; });
    const HalfSprings& springs = pass.model.half_springs;
    Vec3Lanes force(FloatLanes(0.0f));
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
        const NodeLanes other_0 = load_node([&](std::size_t l) { return pairs[l].node_0; });
        add_spring_force(self, other_0, columns.y, stiffness_0, force);
        const NodeLanes other_1 = load_node([&](std::size_t l) { return pairs[l].node_1; });
        add_spring_force(self, other_1, columns.w, stiffness_1, force);
    }
    if (!tets.neo_hookean.empty()) add_tet_forces(d, pass, tets, first, self.position, self.velocity, force);
    if (pass.volume_stresses != nullptr) add_volume_forces(d, pass, tets, first, self.position, force);
    return force;
}

void advance_slices(const Pass<float>& pass, const TetBlocks& tets, Range slices) {
    const Lanes d;
    const std::uint32_t end = std::min(slices.end() * HalfSprings::kSlice, pass.model.node_count());
    std::uint32_t n = slices.first * HalfSprings::kSlice;
    for (; n + kLanes <= end; n += kLanes) {
        prefetch_lanes(pass.positions + n + kNodesAhead);
        prefetch_lanes(pass.velocities + n + kNodesAhead);
        const Vec3Lanes force = gather_lanes(d, pass, tets, n);
        HWY_ALIGN float x[kLanes], y[kLanes], z[kLanes];
        hn::Store(force.x.v, d, x);
        hn::Store(force.y.v, d, y);
        hn::Store(force.z.v, d, z);
        for (std::uint32_t l = 0; l < kLanes; ++l) integrate_node(pass, n + l, {x[l], y[l], z[l]});
    }
    for (; n < end; ++n) integrate_node(pass, n, gather_forces(pass, n));
}

void find_stresses(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                   std::span<float> stresses, Range slices) {
    const Lanes d;
    const Vec4<float>* positions = at.positions.data();
    const std::uint32_t end = std::min(slices.end() * HalfSprings::kSlice, model.node_count());
    std::uint32_t n = slices.first * HalfSprings::kSlice;
    for (; n + kLanes <= end; n += kLanes)
        hn::StoreU(volume_stresses(d, model.volume_term, tets, positions, n).v, d, &stresses[n]);
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

TetBlocks make_pass_tets(const Model& model) {
    if (model.neo_hookean_tets.empty() && model.volume_term.is_empty()) return {};
    std::vector<std::uint32_t> nodes(model.node_count());
    std::iota(nodes.begin(), nodes.end(), 0u);
    while (nodes.size() % kGroup != 0) nodes.push_back(kNoNode);
    return make_tet_blocks(model, nodes, make_node_tets(model.node_count(), model.tets));
}

void advance_nodes_simd(const Pass<float>& pass, const TetBlocks& tets, Range slices) {
    HWY_DYNAMIC_DISPATCH(advance_slices)(pass, tets, slices);
}

void find_volume_stresses_simd(const Model& model, const TetBlocks& tets, const Nodes<float>& at,
                               std::span<float> stresses, Range slices) {
    HWY_DYNAMIC_DISPATCH(find_stresses)(model, tets, at, stresses, slices);
}

const char* simd_target() {
    return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace gelatin::cpu
#endif
