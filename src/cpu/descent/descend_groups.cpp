// As in advance_nodes_simd.cpp: eight rows at a time, one a lane, compiled once for each instruction set.
#include "cpu/descent/descend_groups.h"

#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/descent/descend_groups.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/descent/gather_tets-inl.h"
#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// 1 / sqrt(squared), where that is finite, to rounding.
HWY_INLINE Vector inverse_root(Lanes d, Vector squared) {
    return hn::Div(hn::Set(d, 1.0f), hn::Sqrt(squared));
}

struct SpringSums {
    Vector force_x, force_y, force_z, xx, yy, zz, yz, zx, xy, across;
};

// cpu::add_spring for a lane each, by what multiplies the vector to the other end: with d that vector and l
// its length, s = K (1 - M / l), the force is s d, and the Hessian max(0, s) + (K - max(0, s)) d d^T / l^2.
// A spring of no length adds nothing.
HWY_INLINE void add_spring_lanes(Lanes d, Vector dx, Vector dy, Vector dz, Vector squared, Vector rest_length,
                                 Vector stiffness, SpringSums& sums) {
    const Vector inverse_length = inverse_root(d, hn::Max(squared, hn::Set(d, 1e-30f)));
    const Vector scale = hn::NegMulAdd(hn::Mul(stiffness, rest_length), inverse_length, stiffness);
    sums.force_x = hn::MulAdd(scale, dx, sums.force_x);
    sums.force_y = hn::MulAdd(scale, dy, sums.force_y);
    sums.force_z = hn::MulAdd(scale, dz, sums.force_z);

    const Vector across = hn::Max(scale, hn::Zero(d));
    sums.across = hn::Add(sums.across, across);
    const Vector along = hn::Sub(stiffness, across);
    const Vector nx = hn::Mul(dx, inverse_length), ny = hn::Mul(dy, inverse_length),
                 nz = hn::Mul(dz, inverse_length);
    const Vector along_x = hn::Mul(along, nx), along_y = hn::Mul(along, ny), along_z = hn::Mul(along, nz);
    sums.xx = hn::MulAdd(along_x, nx, sums.xx);
    sums.yy = hn::MulAdd(along_y, ny, sums.yy);
    sums.zz = hn::MulAdd(along_z, nz, sums.zz);
    sums.yz = hn::MulAdd(along_y, nz, sums.yz);
    sums.zx = hn::MulAdd(along_z, nx, sums.zx);
    sums.xy = hn::MulAdd(along_x, ny, sums.xy);
}

// Adds the springs' terms.
HWY_INLINE void gather_lanes(Lanes d, std::span<const SpringBlock> blocks, std::uint32_t row,
                             const Columns& self, const float* positions, TermColumns& terms) {
    const Vector zero = hn::Zero(d);
    SpringSums sums{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (const SpringBlock& block : blocks) {
        const Columns other = load_nodes(d, positions, &block.nodes[row]);
        const Vector dx = hn::Sub(other.x, self.x), dy = hn::Sub(other.y, self.y),
                     dz = hn::Sub(other.z, self.z);
        const Vector squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const Vector stiffness = hn::LoadU(d, &block.stiffnesses[row]);
        add_spring_lanes(d, dx, dy, dz, squared, hn::LoadU(d, &block.rest_lengths[row]), stiffness, sums);
    }
    const auto add = [&](Vector sum, TermColumns::Column& column)
                         HWY_ATTR { hn::StoreU(hn::Add(sum, hn::LoadU(d, &column[row])), d, &column[row]); };
    add(sums.force_x, terms.force[0]);
    add(sums.force_y, terms.force[1]);
    add(sums.force_z, terms.force[2]);
    add(hn::Add(sums.xx, sums.across), terms.diagonal[0]);
    add(hn::Add(sums.yy, sums.across), terms.diagonal[1]);
    add(hn::Add(sums.zz, sums.across), terms.diagonal[2]);
    add(sums.yz, terms.beside[0]);
    add(sums.zx, terms.beside[1]);
    add(sums.xy, terms.beside[2]);
}

HWY_INLINE void add_terms(Lanes d, std::uint32_t row, const TermLanes& added, TermColumns& terms) {
    const auto add = [&](const Vec3Lanes& v, std::array<TermColumns::Column, 3>& columns) HWY_ATTR {
        hn::StoreU(hn::Add(v.x.v, hn::LoadU(d, &columns[0][row])), d, &columns[0][row]);
        hn::StoreU(hn::Add(v.y.v, hn::LoadU(d, &columns[1][row])), d, &columns[1][row]);
        hn::StoreU(hn::Add(v.z.v, hn::LoadU(d, &columns[2][row])), d, &columns[2][row]);
    };
    add(added.force, terms.force);
    add(added.hessian.diagonal, terms.diagonal);
    add(added.hessian.beside, terms.beside);
}

HWY_INLINE Vector inverse_or_zero(Lanes d, Vector pivot, Vector diagonal) {
    const Vector least = hn::Mul(hn::Set(d, 8 * std::numeric_limits<float>::epsilon()), diagonal);
    const Vector sound = hn::Max(pivot, least);
    return hn::IfThenElseZero(hn::Gt(sound, hn::Zero(d)), hn::Div(hn::Set(d, 1.0f), sound));
}

// cpu::solve for a lane each, from where the nodes are.
HWY_INLINE Columns moved_lanes(Lanes d, std::uint32_t row, const Columns& from, const TermColumns& terms) {
    const auto load = [&](const TermColumns::Column& column) HWY_ATTR { return hn::LoadU(d, &column[row]); };
    const Vector dx = load(terms.diagonal[0]), dy = load(terms.diagonal[1]), dz = load(terms.diagonal[2]);
    const Vector bx = load(terms.beside[0]), by = load(terms.beside[1]), bz = load(terms.beside[2]);
    const Vector vx = load(terms.force[0]), vy = load(terms.force[1]), vz = load(terms.force[2]);
    const Vector i0 = inverse_or_zero(d, dx, dx);
    const Vector l10 = hn::Mul(bz, i0), l20 = hn::Mul(by, i0);
    const Vector i1 = inverse_or_zero(d, hn::NegMulAdd(l10, bz, dy), dy);
    const Vector rest = hn::NegMulAdd(l20, bz, bx), l21 = hn::Mul(rest, i1);
    const Vector i2 = inverse_or_zero(d, hn::NegMulAdd(l21, rest, hn::NegMulAdd(l20, by, dz)), dz);
    const Vector y1 = hn::NegMulAdd(l10, vx, vy);
    const Vector y2 = hn::NegMulAdd(l21, y1, hn::NegMulAdd(l20, vx, vz));
    const Vector z = hn::Mul(y2, i2), y = hn::NegMulAdd(l21, z, hn::Mul(y1, i1));
    const Vector x = hn::NegMulAdd(l20, z, hn::NegMulAdd(l10, y, hn::Mul(vx, i0)));
    return {hn::Add(from.x, x), hn::Add(from.y, y), hn::Add(from.z, z), from.w};
}

HWY_INLINE void add_inertia(Lanes d, std::uint32_t row, const Columns& self, const Columns& target,
                            TermColumns& terms) {
    const auto add = [&](Vector value, TermColumns::Column& column) HWY_ATTR {
        hn::StoreU(hn::Add(value, hn::LoadU(d, &column[row])), d, &column[row]);
    };
    add(hn::Mul(target.w, hn::Sub(target.x, self.x)), terms.force[0]);
    add(hn::Mul(target.w, hn::Sub(target.y, self.y)), terms.force[1]);
    add(hn::Mul(target.w, hn::Sub(target.z, self.z)), terms.force[2]);
    for (TermColumns::Column& column : terms.diagonal) add(target.w, column);
}

// A bit a lane.
HWY_INLINE std::uint32_t near_colliders(Lanes d, std::span<const ColliderBound> colliders,
                                        const Columns& position) {
    const Vector zero = hn::Zero(d);
    auto is_near = hn::Ne(zero, zero);
    for (const ColliderBound& bound : colliders) {
        const Vector x = hn::Set(d, bound.place.x), y = hn::Set(d, bound.place.y),
                     z = hn::Set(d, bound.place.z), w = hn::Set(d, bound.place.w);
        if (bound.is_plane) {
            const Vector height =
                hn::MulAdd(x, position.x, hn::MulAdd(y, position.y, hn::Mul(z, position.z)));
            is_near = hn::Or(is_near, hn::Lt(height, w));
        } else {
            const Vector px = hn::Sub(position.x, x), py = hn::Sub(position.y, y),
                         pz = hn::Sub(position.z, z);
            is_near = hn::Or(is_near, hn::Lt(hn::MulAdd(px, px, hn::MulAdd(py, py, hn::Mul(pz, pz))), w));
        }
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, is_near, bits);
    return bits[0];
}

std::span<const SpringBlock> blocks_of(const SpringBlocks& springs, std::size_t group) {
    return {springs.blocks.data() + springs.starts[group], springs.blocks.data() + springs.starts[group + 1]};
}

// Of kLanes rows. Returns where their nodes and targets are.
HWY_INLINE std::array<Columns, 2> gather_terms(Lanes d, const DescentGroups& from, std::size_t group,
                                               std::uint32_t row, const std::uint32_t* shown,
                                               std::span<const glm::vec4> positions, TermColumns& terms) {
    const std::span<const SpringBlock> blocks = blocks_of(from.springs, group);
    const Columns self = load_nodes(d, &positions[0].x, &shown[row]);
    const Columns target = load_nodes(d, &from.targets[0].x, &shown[row]);
    add_inertia(d, row, self, target, terms);
    gather_lanes(d, blocks, row, self, &positions[0].x, terms);
    if (!from.tets.blocks.is_empty()) {
        const TermLanes of_tets = gather_tets(d, from, group, row, shown, self, &positions[0].x);
        add_terms(d, row, of_tets, terms);
    }
    return {self, target};
}

void gather_rows(const DescentGroups& from, std::size_t group, std::span<const glm::vec4> positions,
                 TermColumns& terms) {
    const Lanes d;
    const std::array<std::uint32_t, kGroup> shown = shown_nodes(&from.nodes[group * kGroup]);
    for (std::uint32_t row = 0; row < kGroup; row += kLanes)
        gather_terms(d, from, group, row, shown.data(), positions, terms);
}

std::uint32_t descend_rows(const DescentGroups& from, std::size_t group, TermColumns& terms,
                           std::span<glm::vec4> positions) {
    const Lanes d;
    const std::uint32_t* nodes = &from.nodes[group * kGroup];
    const std::array<std::uint32_t, kGroup> shown = shown_nodes(nodes);
    std::uint32_t may_be_inside = 0;
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const auto [self, target] = gather_terms(d, from, group, row, shown.data(), positions, terms);
        const Columns moved = moved_lanes(d, row, self, terms);
        may_be_inside |= near_colliders(d, from.colliders, moved) << row;
        HWY_ALIGN float rows[4 * kLanes];
        HWY_ALIGN float inertias[kLanes];
        hn::StoreInterleaved4(moved.x, moved.y, moved.z, moved.w, d, rows);
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

HWY_EXPORT(gather_rows);
HWY_EXPORT(descend_rows);

void gather_group(const DescentGroups& from, std::size_t group, std::span<const glm::vec4> positions,
                  TermColumns& terms) {
    HWY_DYNAMIC_DISPATCH(gather_rows)(from, group, positions, terms);
}

std::uint32_t descend_group(const DescentGroups& from, std::size_t group, TermColumns& terms,
                            std::span<glm::vec4> positions) {
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
