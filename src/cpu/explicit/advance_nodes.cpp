#include "cpu/explicit/advance_nodes.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "cpu/elasticity/volume_term.h"
#include "cpu/explicit/gather_forces.h"
#include "cpu/explicit/integrate_node.h"
#include "model/solver.h"

namespace gelatin::cpu {
namespace {

template <class T>
void prefetch(const T* first, std::size_t count) {
    constexpr std::size_t kLine = 64;  // bytes
    for (std::size_t offset = 0; offset < count * sizeof(T); offset += kLine) {
        __builtin_prefetch(reinterpret_cast<const char*>(first) + offset);
    }
}

// Nodes read their slice with a stride, and gather from their whole object: the hardware's prefetching
// handles neither.
void prefetch_springs(const HalfSprings& springs, std::uint32_t slice) {
    if (slice + 1 >= springs.slice_starts.size()) return;
    const std::uint32_t start = springs.slice_starts[slice], count = springs.slice_starts[slice + 1] - start;
    prefetch(springs.pairs.data() + start, count);
    prefetch(springs.stiffness.data() + start, count);
}

}  // namespace

template <class Real>
Pass<Real> make_pass(const Model& model, const ExplicitScheme& scheme, int index, double step,
                     const Nodes<Real>& base, const Nodes<Real>& at, Nodes<Real>& out, Nodes<Real>& sums) {
    const ExplicitScheme::Pass& weights = scheme.passes[static_cast<std::size_t>(index)];
    const Vec3<Real> gravity(model.gravity);
    return {.model = model,
            .gravity = gravity,
            .resting_speed = static_cast<Real>(resting_speed(model.gravity, step)),
            .step = static_cast<Real>(step),
            .weight = static_cast<Real>(weights.weight),
            .next_step = static_cast<Real>(step * weights.next),
            .first = index == 0,
            .last = index + 1 == scheme.pass_count,
            .semi_implicit = scheme.semi_implicit,
            .load_forces = nullptr,
            .volume_stresses = nullptr,
            .base_positions = base.positions.data(),
            .base_velocities = base.velocities.data(),
            .positions = at.positions.data(),
            .velocities = at.velocities.data(),
            .sum_positions = sums.positions.data(),
            .sum_velocities = sums.velocities.data(),
            .out_positions = out.positions.data(),
            .out_velocities = out.velocities.data()};
}

template <class Real>
void find_volume_stresses(const Model& model, const Nodes<Real>& at, std::span<Real> stresses, Range slices) {
    const std::uint32_t first = slices.first * HalfSprings::kSlice;
    const std::uint32_t end = std::min(slices.end() * HalfSprings::kSlice, model.node_count());
    for (std::uint32_t n = first; n < end; ++n)
        stresses[n] = volume_stress_round(model.volume_term, n, at.positions.data());
}

template <class Real>
void advance_nodes(const Pass<Real>& pass, Range slices) {
    for (std::uint32_t slice = slices.first; slice < slices.end(); ++slice) {
        prefetch_springs(pass.model.half_springs, slice + 1);
        const std::uint32_t first = slice * HalfSprings::kSlice;
        prefetch(pass.positions + first + kNodesAhead, HalfSprings::kSlice);
        prefetch(pass.velocities + first + kNodesAhead, HalfSprings::kSlice);
        const std::uint32_t end = std::min(first + HalfSprings::kSlice, pass.model.node_count());
        for (std::uint32_t n = first; n < end; ++n) integrate_node(pass, n, gather_forces(pass, n));
    }
}

template <class Real>
void write_spring_forces(const Pass<Real>& pass, std::span<Vec4<Real>> spring_forces, Range springs) {
    for (std::uint32_t s = springs.first; s < springs.end(); ++s) {
        const Spring& spring = pass.model.springs[s];
        const Vec3<Real> force = spring_force(pass.positions, pass.velocities, spring.i, spring.j,
                                              spring.rest_length, spring.stiffness);
        spring_forces[s] = Vec4<Real>(force, 0);
    }
}

template <class Real>
void merge_spring_forces(const Model& model, std::span<const Vec4<Real>> spring_forces,
                         std::span<Vec4<Real>> node_forces, Range nodes) {
    const SpringIncidence& incidence = model.incidence;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n) {
        Vec3<Real> force(0);
        for (std::uint32_t e = incidence.starts[n]; e < incidence.starts[n + 1]; ++e) {
            const std::uint32_t entry = incidence.entries[e];
            const Vec3<Real> on_first(spring_forces[entry / 2]);
            force += entry % 2 == 0 ? on_first : -on_first;
        }
        node_forces[n] = Vec4<Real>(force, 0);
    }
}

template <class Real>
void integrate_nodes(const Pass<Real>& pass, std::span<const Vec4<Real>> node_forces, Range nodes) {
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        integrate_node(
            pass, n, Vec3<Real>(node_forces[n]) + gather_tet_forces(pass, n) + gather_volume_forces(pass, n));
}

#define GELATIN_INSTANTIATE(Real)                                                                            \
    template Pass<Real> make_pass<Real>(const Model&, const ExplicitScheme&, int, double,                    \
                                        const Nodes<Real>&, const Nodes<Real>&, Nodes<Real>&, Nodes<Real>&); \
    template void find_volume_stresses<Real>(const Model&, const Nodes<Real>&, std::span<Real>, Range);      \
    template void advance_nodes<Real>(const Pass<Real>&, Range);                                             \
    template void write_spring_forces<Real>(const Pass<Real>&, std::span<Vec4<Real>>, Range);                \
    template void merge_spring_forces<Real>(const Model&, std::span<const Vec4<Real>>,                       \
                                            std::span<Vec4<Real>>, Range);                                   \
    template void integrate_nodes<Real>(const Pass<Real>&, std::span<const Vec4<Real>>, Range);
GELATIN_INSTANTIATE(float)
GELATIN_INSTANTIATE(double)
#undef GELATIN_INSTANTIATE

}  // namespace gelatin::cpu
