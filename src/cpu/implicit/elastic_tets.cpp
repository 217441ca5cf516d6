// As in advance_nodes_simd.cpp: eight tets or edges at a time, one a lane, compiled once for each instruction
// set.
#include "cpu/implicit/elastic_lanes.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cpu/implicit/elastic_tets.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "cpu/implicit/elastic_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

// Stores m of the lane l at to(l), by columns.
template <class To>
HWY_INLINE void store_matrices(Lanes d, const Mat3Lanes& m, const To& to) {
    HWY_ALIGN float first[4 * kLanes], second[4 * kLanes], last[kLanes];
    hn::StoreInterleaved4(m[0].x.v, m[0].y.v, m[0].z.v, m[1].x.v, d, first);
    hn::StoreInterleaved4(m[1].y.v, m[1].z.v, m[2].x.v, m[2].y.v, d, second);
    hn::Store(m[2].z.v, d, last);
    for (std::size_t l = 0; l < kLanes; ++l) {
        float* matrix = to(l);
        std::memcpy(matrix, first + 4 * l, 4 * sizeof(float));
        std::memcpy(matrix + 4, second + 4 * l, 4 * sizeof(float));
        matrix[8] = last[l];
    }
}

// a b^T
HWY_INLINE Mat3Lanes outer(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {b.x * a, b.y * a, b.z * a};
}

HWY_INLINE Mat3Lanes transposed(const Mat3Lanes& m) {
    return {{m[0].x, m[1].x, m[2].x}, {m[0].y, m[1].y, m[2].y}, {m[0].z, m[1].z, m[2].z}};
}

// v -> axis x v
HWY_INLINE Mat3Lanes crossing(const Vec3Lanes& axis) {
    const FloatLanes zero(0.0f);
    return {{zero, axis.z, -axis.y}, {-axis.z, zero, axis.x}, {axis.y, -axis.x, zero}};
}

struct TetEnds {
    Columns corners[4];
    Vec3Lanes sides[3];  // from corner 0

    HWY_INLINE TetEnds(Lanes d, const float* rows, const ElasticTets& tets, std::uint32_t row) {
        for (std::size_t c = 0; c < 4; ++c) corners[c] = load_nodes(d, rows, &tets.nodes[c][row]);
        for (int k = 0; k < 3; ++k) sides[k] = difference(corners[k + 1], corners[0]);
    }
    HWY_INLINE FloatLanes sum() const {
        return FloatLanes(corners[0].w) + FloatLanes(corners[1].w) + FloatLanes(corners[2].w) +
               FloatLanes(corners[3].w);
    }
};

// dJ/dx of the corners 1, 2, 3.
HWY_INLINE Mat3Lanes volume_slopes(Lanes d, const TetEnds& ends, const ElasticTets& tets, std::uint32_t row) {
    const FloatLanes inverse = load(d, tets.inverse_six_volumes, row);
    return {volume_slope(ends.sides[1], ends.sides[2], inverse),
            volume_slope(ends.sides[2], ends.sides[0], inverse),
            volume_slope(ends.sides[0], ends.sides[1], inverse)};
}

// Of the corners 1, 2, 3 and then 0, with which they sum to 0; w is the same in all.
HWY_INLINE void store_corners(Lanes d, const Mat3Lanes& others, FloatLanes w, TetRows* rows) {
    const Vec3Lanes corners[4] = {FloatLanes(-1.0f) * (others[0] + others[1] + others[2]), others[0],
                                  others[1], others[2]};
    for (std::size_t c = 0; c < 4; ++c) {
        HWY_ALIGN float lanes[4 * kLanes];
        hn::StoreInterleaved4(corners[c].x.v, corners[c].y.v, corners[c].z.v, w.v, d, lanes);
        for (std::size_t l = 0; l < kLanes; ++l)
            std::memcpy(&rows[l].corners[c], lanes + 4 * l, 4 * sizeof(float));
    }
}

HWY_FLATTEN void tet_volumes(const ElasticStart& start, std::size_t group, ElasticArrays& arrays) {
    const Lanes d;
    const ElasticTets& tets = arrays.tets[group];
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const TetEnds ends(d, &start.positions[0].x, tets, row);
        const FloatLanes six_volumes = dot(ends.sides[0], cross(ends.sides[1], ends.sides[2]));
        const FloatLanes quarter =
            six_volumes * load(d, tets.inverse_six_volumes, row) * load(d, tets.quarter_volumes, row);
        hn::StoreU(quarter.v, d, &arrays.tet_volumes[kGroup * group + row]);
    }
}

// cpu/elasticity/tet_volume.inl: the bound of the volume term, and what resists being flat.
HWY_FLATTEN void spring_tets(const ElasticStart& start, std::size_t group, ElasticArrays& arrays) {
    const Lanes d;
    const ElasticTets& tets = arrays.tets[group];
    const FloatLanes zero(0.0f);
    const bool resisted = arrays.resists[group] != 0;
    bool resists = false;
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const float* rows = arrays.has_volume_term ? &arrays.points[0].x : &start.positions[0].x;
        const TetEnds ends(d, rows, tets, row);
        const Mat3Lanes slopes = volume_slopes(d, ends, tets, row);
        const FloatLanes lack = FloatLanes(static_cast<float>(kFlattest)) - dot(ends.sides[0], slopes[0]);
        const FloatLanes flat = select(lack > zero, load(d, tets.flat_moduli, row), zero);
        FloatLanes pressure = -(flat * lack);
        if (arrays.has_volume_term)
            pressure = multiply_add(load(d, tets.quarter_volumes, row), ends.sum(), pressure);
        const FloatLanes weight = flat + load(d, tets.volume_moduli, row);
        const LaneMask counts = weight > zero;
        if (!hn::AllFalse(d, counts)) resists = true;
        if (!resists && !resisted) continue;
        const FloatLanes root = square_root(weight), force = hn::IfThenElseZero(counts, (pressure / root).v);
        store_corners(d, root * slopes, force, &arrays.tet_rows[kGroup * group + row]);
    }
    arrays.resists[group] = resists ? 1 : 0;
}

// The largest singular value of F is at most this: the root of the largest sum of a row of F^T F
// (Gershgorin).
HWY_INLINE FloatLanes largest_stretch(const Mat3Lanes& f) {
    const FloatLanes xy = hn::Abs(dot(f[0], f[1]).v), yz = hn::Abs(dot(f[1], f[2]).v),
                     zx = hn::Abs(dot(f[2], f[0]).v);
    return square_root(
        larger(larger(dot(f[0], f[0]) + xy + zx, dot(f[1], f[1]) + xy + yz), dot(f[2], f[2]) + yz + zx));
}

// ElasticSystem<double>::linearise_neo_hookean, and of each of its edges what a corner's force changes by
// with another's displacement.
HWY_FLATTEN void neo_hookean_tets(const ElasticStart& start, std::size_t group, ElasticArrays& arrays) {
    const Lanes d;
    const ElasticTets& tets = arrays.tets[group];
    const std::size_t own_group = group - arrays.first_neo_hookean;
    const ElasticNeoHookean& columns = arrays.neo_hookean[own_group];
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const float* rows = arrays.has_volume_term ? &arrays.points[0].x : &start.positions[0].x;
        const TetEnds ends(d, rows, tets, row);
        Vec3Lanes g[4];
        for (std::size_t c = 0; c < 3; ++c) g[c + 1] = load(d, columns.gradients[c], row);
        g[0] = FloatLanes(-1.0f) * (g[1] + g[2] + g[3]);
        const TetModuli<FloatLanes> moduli{load(d, columns.mu, row), load(d, columns.lambda, row)};
        const Mat3Lanes f =
            outer(ends.sides[0], g[1]) + outer(ends.sides[1], g[2]) + outer(ends.sides[2], g[3]);
        const Mat3Lanes cofactors = cofactor<FloatLanes>(f);
        const FloatLanes squares = double_dot(f, f), ratio = dot(f[0], cofactors[0]);
        const FloatLanes inverse = FloatLanes(1.0f) / (squares + FloatLanes(1.0f));
        const NeoHookeanStress<FloatLanes> stress = neo_hookean_stress(squares, inverse, ratio, moduli);
        const FloatLanes most = stress.shear / larger(largest_stretch(f), FloatLanes(1e-6f));
        const FloatLanes twist = hn::Clamp(stress.pressure.v, (-most).v, most.v);
        FloatLanes pressure = stress.pressure;
        if (arrays.has_volume_term)
            pressure = multiply_add(load(d, tets.quarter_volumes, row), ends.sum(), pressure);

        Vec3Lanes stretched[4], slopes[4], forces[4];
        for (int c = 0; c < 4; ++c) {
            stretched[c] = f * g[c];
            slopes[c] = cofactors * g[c];
            forces[c] =
                stress.shear * stretched[c] + pressure * slopes[c] - opening_force(g[c], squares, moduli.mu);
        }
        store_corners(d, {forces[1], forces[2], forces[3]}, FloatLanes(1.0f),
                      &arrays.tet_rows[kGroup * group + row]);

        FloatLanes along = FloatLanes(2.0f) * moduli.mu * inverse * inverse, damped_shear(0.0f);
        Mat3Lanes identity_part = {{stress.shear, FloatLanes(0.0f), FloatLanes(0.0f)},
                                   {FloatLanes(0.0f), stress.shear, FloatLanes(0.0f)},
                                   {FloatLanes(0.0f), FloatLanes(0.0f), stress.shear}};
        if (arrays.is_damped) {
            const TetEnds speeds(d, &start.velocities[0].x, tets, row);
            const FloatLanes viscosity =
                FloatLanes(0.25f * start.inverse_step) * speeds.sum() * viscous_share(squares);
            damped_shear = viscosity * FloatLanes(0.75f) * moduli.mu;
            along =
                multiply_add(viscosity, multiply_add(FloatLanes(-0.625f), moduli.mu, moduli.lambda), along);
            for (int k = 0; k < 3; ++k) identity_part = identity_part + outer(damped_shear * f[k], f[k]);
        }
        const FloatLanes weight = moduli.lambda + load(d, tets.volume_moduli, row);
        const FloatLanes turn = twist * load(d, tets.inverse_six_volumes, row);
        const Vec3Lanes* s = ends.sides;
        const Vec3Lanes turns[ElasticArrays::kTetEdges] = {
            s[1] - s[2], s[2] - s[0], s[0] - s[1], FloatLanes(-1.0f) * s[2], s[1], FloatLanes(-1.0f) * s[0]};
        std::size_t edge = 0;
        for (int c = 0; c < 3; ++c) {
            for (int e = c + 1; e < 4; ++e, ++edge) {
                const Mat3Lanes change = dot(g[c], g[e]) * identity_part +
                                         outer(along * stretched[c], stretched[e]) +
                                         outer(damped_shear * stretched[e], stretched[c]) +
                                         outer(weight * slopes[c], slopes[e]) + crossing(turn * turns[edge]);
                store_matrices(d, FloatLanes(-1.0f) * change, [&](std::size_t l) {
                    const std::size_t tet = kGroup * own_group + row + l;
                    return &arrays.tet_matrices[ElasticArrays::kMatrix *
                                                (ElasticArrays::kTetEdges * tet + edge)];
                });
            }
        }
    }
}

// What a tet of each lane adds to M of the lane's edge. These tets are in no order that processors foresee.
HWY_INLINE Mat3Lanes spring_tet_matrices(Lanes d, const IndexColumn* tets, std::uint32_t row,
                                         const ElasticArrays& arrays) {
    for (std::size_t l = 0; l < kLanes; ++l)
        __builtin_prefetch(&arrays.tet_rows[tets[ElasticArrays::kAhead][row + l] / 16]);
    const hn::Rebind<std::uint32_t, Lanes> du;
    const auto numbers = hn::LoadU(du, &(*tets)[row]), three = hn::Set(du, 3u);
    const auto firsts = hn::ShiftRight<2>(numbers);
    HWY_ALIGN std::uint32_t first_rows[kLanes], second_rows[kLanes];
    hn::Store(firsts, du, first_rows);
    hn::Store(hn::Or(hn::AndNot(three, firsts), hn::And(three, numbers)), du, second_rows);
    const float* rows = &arrays.tet_rows[0].corners[0].x;
    const Columns first = load_nodes(d, rows, first_rows), second = load_nodes(d, rows, second_rows);
    return outer({first.x, first.y, first.z}, {second.x, second.y, second.z});
}

HWY_INLINE Mat3Lanes neo_hookean_matrices(Lanes d, const IndexColumn* tets, std::uint32_t row,
                                          const ElasticArrays& arrays) {
    const auto part = [&](const IndexColumn& numbers, std::size_t l, std::size_t offset) {
        return &arrays.tet_matrices[ElasticArrays::kMatrix * std::size_t(numbers[row + l]) + offset];
    };
    HWY_ALIGN float last[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) {
        __builtin_prefetch(part(tets[ElasticArrays::kAhead], l, 0));
        __builtin_prefetch(part(tets[ElasticArrays::kAhead], l, 8));
        last[l] = *part(*tets, l, 8);
    }
    const Columns first = load_columns(d, [&](std::size_t l) { return part(*tets, l, 0); });
    const Columns second = load_columns(d, [&](std::size_t l) { return part(*tets, l, 4); });
    return {
        {first.x, first.y, first.z}, {first.w, second.x, second.y}, {second.z, second.w, hn::Load(d, last)}};
}

HWY_FLATTEN void edge_group(std::size_t group, ElasticArrays& arrays) {
    const Lanes d;
    const EdgeColumns& edges = arrays.edges[group];
    const bool is_neo_hookean = group >= arrays.first_neo_hookean_edges;
    const auto matrix = [&](std::uint32_t place) {
        return &arrays.matrices[ElasticArrays::kMatrix * std::size_t(place)];
    };
    for (std::uint32_t row = 0; row < kGroup; row += kLanes) {
        const Vec3Lanes zero(FloatLanes(0.0f));
        Mat3Lanes sum(zero, zero, zero);
        for (std::uint32_t k = edges.first; k < edges.end; ++k) {
            const IndexColumn* tets = &arrays.edge_tets[k];
            sum = is_neo_hookean ? sum + neo_hookean_matrices(d, tets, row, arrays)
                                 : sum - spring_tet_matrices(d, tets, row, arrays);
        }
        store_matrices(d, sum, [&](std::size_t l) { return matrix(edges.places[row + l]); });
        store_matrices(d, transposed(sum), [&](std::size_t l) { return matrix(edges.places_back[row + l]); });
    }
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gelatin::cpu {

HWY_EXPORT(tet_volumes);
HWY_EXPORT(spring_tets);
HWY_EXPORT(neo_hookean_tets);
HWY_EXPORT(edge_group);

void find_tet_volumes(const ElasticStart& start, std::size_t group, ElasticArrays& arrays) {
    HWY_DYNAMIC_DISPATCH(tet_volumes)(start, group, arrays);
}

void linearise_tets(const ElasticStart& start, std::size_t group, ElasticArrays& arrays) {
    if (group < arrays.first_neo_hookean) {
        HWY_DYNAMIC_DISPATCH(spring_tets)(start, group, arrays);
    } else {
        HWY_DYNAMIC_DISPATCH(neo_hookean_tets)(start, group, arrays);
    }
}

void sum_edges(std::size_t group, ElasticArrays& arrays) {
    HWY_DYNAMIC_DISPATCH(edge_group)(group, arrays);
}

}  // namespace gelatin::cpu
#endif
