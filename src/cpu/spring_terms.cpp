// As in advance_nodes_simd.cpp: eight rows at a time, one a lane, compiled once for each instruction set.
#include "cpu/spring_terms.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/spring_terms.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR

void gather_slice(const SpringRows<float>& from, std::uint32_t slice, NodeTerms<float>* terms) {
    gather_spring_terms<float>(from, slice, terms);
}

#else

struct Rows {
    Columns position, start;
};

struct Terms {
    Vector force_x, force_y, force_z, xx, yy, zz, yz, zx, xy;
};

// cpu::add_spring for a lane each; a spring of no length adds nothing.
HWY_INLINE void add_spring_lanes(Lanes d, const Rows& self, const Rows& other, Vector inverse_step,
                                 Vector squared, Vector rest_length, Vector stiffness, Terms& terms) {
    const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const Vector length = hn::Sqrt(hn::Max(squared, hn::Set(d, 1e-30f)));
    const Vector inverse_length = hn::Div(one, length);
    const Vector dx = hn::Sub(other.position.x, self.position.x);
    const Vector dy = hn::Sub(other.position.y, self.position.y);
    const Vector dz = hn::Sub(other.position.z, self.position.z);
    const Vector nx = hn::Mul(dx, inverse_length), ny = hn::Mul(dy, inverse_length),
                 nz = hn::Mul(dz, inverse_length);

    const Vector ex = hn::Sub(other.start.x, self.start.x);
    const Vector ey = hn::Sub(other.start.y, self.start.y);
    const Vector ez = hn::Sub(other.start.z, self.start.z);
    const Vector start_length = hn::Sqrt(hn::MulAdd(ex, ex, hn::MulAdd(ey, ey, hn::Mul(ez, ez))));
    const Vector damping =
        hn::Mul(hn::Mul(hn::Set(d, 0.5f), hn::Add(self.start.w, other.start.w)), inverse_step);
    const Vector damped = hn::MulAdd(stiffness, damping, stiffness);
    const Vector rest = hn::Div(hn::MulAdd(damping, start_length, rest_length), hn::Add(one, damping));

    const Vector pull = hn::Mul(damped, hn::Sub(length, rest));
    terms.force_x = hn::MulAdd(pull, nx, terms.force_x);
    terms.force_y = hn::MulAdd(pull, ny, terms.force_y);
    terms.force_z = hn::MulAdd(pull, nz, terms.force_z);

    const Vector across = hn::Max(hn::Mul(damped, hn::NegMulAdd(rest, inverse_length, one)), zero);
    const Vector along = hn::Sub(damped, across);
    const Vector along_x = hn::Mul(along, nx), along_y = hn::Mul(along, ny), along_z = hn::Mul(along, nz);
    terms.xx = hn::Add(hn::MulAdd(along_x, nx, terms.xx), across);
    terms.yy = hn::Add(hn::MulAdd(along_y, ny, terms.yy), across);
    terms.zz = hn::Add(hn::MulAdd(along_z, nz, terms.zz), across);
    terms.yz = hn::MulAdd(along_y, nz, terms.yz);
    terms.zx = hn::MulAdd(along_z, nx, terms.zx);
    terms.xy = hn::MulAdd(along_x, ny, terms.xy);
}

// Where nodes coincide, lane by lane: each has a way out of its own.
HWY_INLINE void add_coincident(Lanes d, const SpringRows<float>& from, const std::uint32_t* nodes,
                               Vector squared, Vector stiffness, const HalfSpringPair* pairs, bool is_second,
                               NodeTerms<float>* terms) {
    const auto are_coincident = hn::And(hn::Eq(squared, hn::Zero(d)), hn::Gt(stiffness, hn::Zero(d)));
    if (hn::AllFalse(d, are_coincident)) return;
    HWY_ALIGN float lengths[kLanes], stiffnesses[kLanes];
    hn::Store(squared, d, lengths);
    hn::Store(stiffness, d, stiffnesses);
    for (std::size_t l = 0; l < kLanes; ++l) {
        if (lengths[l] > 0.0f || stiffnesses[l] == 0.0f) continue;
        const HalfSpringPair& pair = pairs[l];
        add_row_spring(from, nodes[l], is_second ? pair.node_1 : pair.node_0,
                       is_second ? pair.rest_length_1 : pair.rest_length_0, stiffnesses[l], terms[l]);
    }
}

// The rows first .. first + kLanes, all of one slice.
HWY_INLINE void gather_lanes(Lanes d, const SpringRows<float>& from, std::uint32_t first,
                             NodeTerms<float>* terms) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = from.rows.springs;
    const float* positions = &from.positions[0].x;
    const float* starts = &from.starts[0].x;
    const auto load = [&](const auto& node) HWY_ATTR {
        return Rows{load_columns(d, [&](std::size_t l) { return positions + 4 * std::size_t(node(l)); }),
                    load_columns(d, [&](std::size_t l) { return starts + 4 * std::size_t(node(l)); })};
    };
    std::uint32_t nodes[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) {
        const std::uint32_t node = from.rows.nodes[first + l];
        nodes[l] = node == kNoNode ? 0 : node;
    }
    const Rows self = load([&](std::size_t l) { return nodes[l]; });
    const Vector inverse_step = hn::Set(d, from.inverse_step), zero = hn::Zero(d);
    Terms sums{zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (std::size_t l = 0; l < kLanes; ++l) terms[l] = {};

    const auto add = [&](const Rows& other, Vector rest_length, Vector stiffness, const HalfSpringPair* pairs,
                         bool is_second) HWY_ATTR {
        const Vector dx = hn::Sub(other.position.x, self.position.x);
        const Vector dy = hn::Sub(other.position.y, self.position.y);
        const Vector dz = hn::Sub(other.position.z, self.position.z);
        const Vector squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        add_spring_lanes(d, self, other, inverse_step, squared, rest_length, stiffness, sums);
        add_coincident(d, from, nodes, squared, stiffness, pairs, is_second, terms);
    };
    const std::uint32_t end = springs.slice_starts[first / kSlice + 1];
    for (std::uint32_t p = springs.slice_starts[first / kSlice] + first % kSlice; p < end; p += kSlice) {
        const HalfSpringPair* pairs = &springs.pairs[p];
        const Columns columns =
            load_columns(d, [&](std::size_t l) { return reinterpret_cast<const float*>(pairs + l); });
        Vector stiffness_0, stiffness_1;
        hn::LoadInterleaved2(d, &springs.stiffness[p].x, stiffness_0, stiffness_1);
        add(load([&](std::size_t l) { return pairs[l].node_0; }), columns.y, stiffness_0, pairs, false);
        add(load([&](std::size_t l) { return pairs[l].node_1; }), columns.w, stiffness_1, pairs, true);
    }

    HWY_ALIGN float values[9][kLanes];
    const Vector all[9] = {sums.force_x, sums.force_y, sums.force_z, sums.xx, sums.yy,
                           sums.zz,      sums.yz,      sums.zx,      sums.xy};
    for (int k = 0; k < 9; ++k) hn::Store(all[k], d, values[k]);
    for (std::size_t l = 0; l < kLanes; ++l) {
        terms[l].force += Vec3<float>(values[0][l], values[1][l], values[2][l]);
        terms[l].hessian.diagonal += Vec3<float>(values[3][l], values[4][l], values[5][l]);
        terms[l].hessian.beside += Vec3<float>(values[6][l], values[7][l], values[8][l]);
    }
}

void gather_slice(const SpringRows<float>& from, std::uint32_t slice, NodeTerms<float>* terms) {
    const Lanes d;
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    for (std::uint32_t row = 0; row < kSlice; row += kLanes)
        gather_lanes(d, from, slice * kSlice + row, terms + row);
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(gather_slice);

void gather_spring_terms_simd(const SpringRows<float>& from, std::uint32_t slice, NodeTerms<float>* terms) {
    HWY_DYNAMIC_DISPATCH(gather_slice)(from, slice, terms);
}

template <class Real>
void gather_spring_terms(const SpringRows<Real>& from, std::uint32_t slice, NodeTerms<Real>* terms) {
    constexpr std::uint32_t kSlice = HalfSprings::kSlice;
    const HalfSprings& springs = from.rows.springs;
    for (std::uint32_t row = 0; row < kSlice; ++row) {
        terms[row] = {};
        const std::uint32_t node = from.rows.nodes[slice * kSlice + row];
        if (node == kNoNode) continue;
        for (std::uint32_t p = springs.slice_starts[slice] + row; p < springs.slice_starts[slice + 1];
             p += kSlice) {
            const HalfSpringPair& pair = springs.pairs[p];
            const glm::vec2& stiffness = springs.stiffness[p];
            if (stiffness.x > 0.0f)
                add_row_spring(from, node, pair.node_0, pair.rest_length_0, stiffness.x, terms[row]);
            if (stiffness.y > 0.0f)
                add_row_spring(from, node, pair.node_1, pair.rest_length_1, stiffness.y, terms[row]);
        }
    }
}

template void gather_spring_terms<float>(const SpringRows<float>&, std::uint32_t, NodeTerms<float>*);
template void gather_spring_terms<double>(const SpringRows<double>&, std::uint32_t, NodeTerms<double>*);

}  // namespace gelatin::cpu
#endif
