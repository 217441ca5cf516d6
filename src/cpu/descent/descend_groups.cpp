// As in advance_nodes_simd.cpp: eight rows at a time, one a lane, compiled once for each instruction set.
#include "cpu/descent/descend_groups.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/descent/descend_groups.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/descent/gather_tets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

using VectorColumns = std::array<TermColumns::Column, 3>;

HWY_INLINE Vec3Lanes load_vectors(Lanes d, const VectorColumns& columns, std::uint32_t row) {
    return Vec3Lanes(hn::LoadU(d, &columns[0][row]), hn::LoadU(d, &columns[1][row]),
                     hn::LoadU(d, &columns[2][row]));
}

HWY_INLINE void store_vectors(Lanes d, const Vec3Lanes& v, VectorColumns& columns, std::uint32_t row) {
    hn::StoreU(v.x.v, d, &columns[0][row]);
    hn::StoreU(v.y.v, d, &columns[1][row]);
    hn::StoreU(v.z.v, d, &columns[2][row]);
}

// Terms here and below: TermLanes or ForceLanes.
template <class Terms>
HWY_INLINE void gather_spring_lanes(Lanes d, const SpringBlocks& springs, std::size_t group,
                                    std::uint32_t row, const Columns& self, const float* positions,
                                    Terms& terms) {
    for (std::uint32_t b = springs.starts[group]; b < springs.starts[group + 1]; ++b) {
        const SpringBlock& block = springs.blocks[b];
        prefetch_block(&block);
        const Columns other = load_nodes(d, positions, &block.nodes[row]);
        const SpringLaw<FloatLanes> spring{hn::LoadU(d, &block.rest_lengths[row]),
                                           hn::LoadU(d, &block.stiffnesses[row])};
        add_spring(difference(other, self), spring, terms);
    }
}

// A bit a lane.
HWY_INLINE std::uint32_t near_colliders(Lanes d, std::span<const ColliderBound> colliders,
                                        const Vec3Lanes& position) {
    const Vector zero = hn::Zero(d);
    LaneMask is_near = hn::Ne(zero, zero);
    for (const ColliderBound& bound : colliders) {
        const Vec3Lanes place(FloatLanes(bound.place.x), FloatLanes(bound.place.y),
                              FloatLanes(bound.place.z));
        const Vec3Lanes from_middle = position - place;
        const FloatLanes value = bound.is_plane ? dot(place, position) : dot(from_middle, from_middle);
        is_near = hn::Or(is_near, value < FloatLanes(bound.place.w));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, is_near, bits);
    return bits[0];
}

// What inertia and all elements but flat tets add to the terms of kLanes rows of nodes, which are at `self`.
template <class Terms>
HWY_INLINE void gather_terms(Lanes d, const DescentGroups& from, std::size_t group, std::uint32_t row,
                             const std::uint32_t* shown, const Columns& self, const Columns& target,
                             std::span<const glm::vec4> positions, Terms& terms) {
    add_point_spring<FloatLanes>(difference(target, self), target.w, terms);
    gather_spring_lanes(d, from.springs, group, row, self, &positions[0].x, terms);
    if (from.tets.blocks.is_empty()) return;
    gather_neo_hookean_lanes(d, from.tets, group, row, shown, self, &positions[0].x, terms);
    gather_volume_lanes(d, from.tets, group, row, self, &positions[0].x, terms);
}

// Flattened: calls of formulas would pass lanes through memory.
HWY_FLATTEN void gather_forces(const DescentGroups& from, std::size_t group,
                               std::span<const glm::vec4> positions, TermColumns& terms) {
    const Lanes d;
    const std::array<std::uint32_t, kGroup> shown = shown_nodes(&from.nodes[group * kGroup]);
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const Columns self = load_nodes(d, &positions[0].x, &shown[row]);
        const Columns target = load_nodes(d, &from.targets[0].x, &shown[row]);
        ForceLanes sum;
        sum.force = load_vectors(d, terms.force, row);
        gather_terms(d, from, group, row, shown.data(), self, target, positions, sum);
        store_vectors(d, sum.force, terms.force, row);
    }
}

HWY_FLATTEN std::uint32_t descend_rows(const DescentGroups& from, std::size_t group, TermColumns& terms,
                                       std::span<glm::vec4> positions) {
    const Lanes d;
    const std::uint32_t* nodes = &from.nodes[group * kGroup];
    const std::array<std::uint32_t, kGroup> shown = shown_nodes(nodes);
    std::uint32_t may_be_inside = 0;
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const Columns self = load_nodes(d, &positions[0].x, &shown[row]);
        const Columns target = load_nodes(d, &from.targets[0].x, &shown[row]);
        TermLanes sum(load_vectors(d, terms.force, row),
                      {load_vectors(d, terms.diagonal, row), load_vectors(d, terms.beside, row)});
        gather_terms(d, from, group, row, shown.data(), self, target, positions, sum);
        store_vectors(d, sum.force, terms.force, row);
        store_vectors(d, sum.hessian.diagonal, terms.diagonal, row);
        store_vectors(d, sum.hessian.beside, terms.beside, row);
        const Vec3Lanes moved = Vec3Lanes(self.x, self.y, self.z) + solve(sum);
        may_be_inside |= near_colliders(d, from.colliders, moved) << row;
        HWY_ALIGN float rows[4 * kLanes];
        HWY_ALIGN float inertias[kLanes];
        hn::StoreInterleaved4(moved.x.v, moved.y.v, moved.z.v, self.w, d, rows);
        hn::Store(target.w, d, inertias);
        for (std::size_t l = 0; l < kLanes; ++l) {
            if (nodes[row + l] == kNoNode || inertias[l] == 0.0f) {
                may_be_inside &= ~(1u << (row + l));
                continue;
            }
            std::memcpy(&positions[nodes[row + l]], &rows[4 * l], sizeof(glm::vec4));
        }
    }
    return may_be_inside;
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(gather_forces);
HWY_EXPORT(descend_rows);

void gather_group_forces(const DescentGroups& from, std::size_t group, std::span<const glm::vec4> positions,
                         TermColumns& terms) {
    if (is_empty_group(&from.nodes[group * kGroup])) return;
    HWY_DYNAMIC_DISPATCH(gather_forces)(from, group, positions, terms);
}

std::uint32_t descend_group(const DescentGroups& from, std::size_t group, TermColumns& terms,
                            std::span<glm::vec4> positions) {
    if (is_empty_group(&from.nodes[group * kGroup])) return 0;
    return HWY_DYNAMIC_DISPATCH(descend_rows)(from, group, terms, positions);
}

NodeTerms<float> TermColumns::row(std::size_t r) const {
    return {{force[0][r], force[1][r], force[2][r]},
            {{diagonal[0][r], diagonal[1][r], diagonal[2][r]}, {beside[0][r], beside[1][r], beside[2][r]}}};
}

void TermColumns::add(std::size_t r, const NodeTerms<float>& terms) {
    for (int k = 0; k < 3; ++k) {
        const auto column = static_cast<std::size_t>(k);
        force[column][r] += terms.force[k];
        diagonal[column][r] += terms.hessian.diagonal[k];
        beside[column][r] += terms.hessian.beside[k];
    }
}

std::vector<ColliderBound> make_collider_bounds(std::span<const Collider> colliders) {
    std::vector<ColliderBound> bounds;
    for (const Collider& collider : colliders) {
        if (collider.kind == 0) {
            bounds.push_back({collider.center, true});
            continue;
        }
        // Of the ball round it: a box's half diagonal, half of a capsule's axis and its radius; a little
        // more, for rounding.
        float radius = 1.001f * (collider.kind == 1 ? 0.0f : collider.center.w);
        if (collider.kind != 2) radius += 1.001f * glm::length(glm::vec3(collider.axis));
        bounds.push_back({glm::vec4(glm::vec3(collider.center), radius * radius), false});
    }
    return bounds;
}

}  // namespace gelatin::cpu
#endif
