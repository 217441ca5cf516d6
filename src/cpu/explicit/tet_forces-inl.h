// cpu::gather_tet_forces with one node in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_TET_FORCES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_TET_FORCES
#undef GELATIN_CPU_TET_FORCES
#else
#define GELATIN_CPU_TET_FORCES
#endif

#include "cpu/elasticity/neo_hookean.h"
#include "cpu/explicit/advance_nodes.h"
#include "cpu/simd_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

// Columns of a matrix.
struct Matrix3 {
    Vector3 x, y, z;
};

HWY_INLINE Vector3 multiply(const Matrix3& m, const Vector3& v) {
    return add_scaled(add_scaled(scaled(v.x, m.x), v.y, m.y), v.z, m.z);
}

// One tet in each lane, and the gradient of the corner that is the lane's node.
struct TetLanes {
    const NeoHookeanTet* tets[kLanes];
    Columns gradients[3];  // w: volume, mu, lambda
    Vector3 own;

    HWY_INLINE TetLanes(Lanes d, const Model& model, const std::uint32_t* entries) {
        HWY_ALIGN float corners[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            tets[l] = &model.neo_hookean_tets[entries[l] / 4];
            corners[l] = static_cast<float>(entries[l] % 4);
        }
        gradients[0] = load_columns(d, [&](std::size_t l) { return &tets[l]->gradient_1.x; });
        gradients[1] = load_columns(d, [&](std::size_t l) { return &tets[l]->gradient_2.x; });
        gradients[2] = load_columns(d, [&](std::size_t l) { return &tets[l]->gradient_3.x; });
        const Vector corner = hn::Load(d, corners);
        const auto choose = [&](Vector g1, Vector g2, Vector g3) HWY_ATTR {
            const Vector g0 = hn::Neg(hn::Add(hn::Add(g1, g2), g3));
            const Vector low = hn::IfThenElse(hn::Eq(corner, hn::Set(d, 1.0f)), g1, g0);
            const Vector high = hn::IfThenElse(hn::Eq(corner, hn::Set(d, 2.0f)), g2, g3);
            return hn::IfThenElse(hn::Lt(corner, hn::Set(d, 2.0f)), low, high);
        };
        own = {choose(gradients[0].x, gradients[1].x, gradients[2].x),
               choose(gradients[0].y, gradients[1].y, gradients[2].y),
               choose(gradients[0].z, gradients[1].z, gradients[2].z)};
    }

    // Values at a corner of each lane's tet.
    HWY_INLINE Columns at_corner(Lanes d, const Vec4<float>* values,
                                 std::uint32_t NeoHookeanTet::*node) const {
        return load_columns(d, [&](std::size_t l) { return &values[tets[l]->*node].x; });
    }

    // As cpu::gradient_of; also adds up the fourth components of the values.
    HWY_INLINE Matrix3 gradient_of(Lanes d, const Vec4<float>* values, Vector& sum_of_w) const {
        const Columns at_0 = at_corner(d, values, &NeoHookeanTet::node_0),
                      at_1 = at_corner(d, values, &NeoHookeanTet::node_1),
                      at_2 = at_corner(d, values, &NeoHookeanTet::node_2),
                      at_3 = at_corner(d, values, &NeoHookeanTet::node_3);
        sum_of_w = hn::Add(hn::Add(at_0.w, at_1.w), hn::Add(at_2.w, at_3.w));
        const Vector3 a = subtract(at_1, at_0), b = subtract(at_2, at_0), c = subtract(at_3, at_0);
        const auto column = [&](Vector g1, Vector g2, Vector g3)
                                HWY_ATTR { return add_scaled(add_scaled(scaled(g1, a), g2, b), g3, c); };
        return {column(gradients[0].x, gradients[1].x, gradients[2].x),
                column(gradients[0].y, gradients[1].y, gradients[2].y),
                column(gradients[0].z, gradients[1].z, gradients[2].z)};
    }
};

// As cpu::viscous_stress, times g.
HWY_INLINE Vector3 viscous_traction(Lanes d, const Matrix3& f, const Matrix3& rate, const TetLanes& tet) {
    const Vector mu = tet.gradients[1].w;
    const Vector shear = hn::Mul(hn::Set(d, 0.75f), mu);
    const Vector xx = dot(f.x, rate.x), yy = dot(f.y, rate.y), zz = dot(f.z, rate.z);
    const Vector xy = hn::Add(dot(f.x, rate.y), dot(f.y, rate.x)),
                 yz = hn::Add(dot(f.y, rate.z), dot(f.z, rate.y)),
                 zx = hn::Add(dot(f.z, rate.x), dot(f.x, rate.z));
    const Vector dilation =
        hn::Mul(hn::NegMulAdd(hn::Set(d, 0.625f), mu, tet.gradients[2].w), hn::Add(xx, hn::Add(yy, zz)));
    const Matrix3 twice_strain{
        {hn::Add(xx, xx), xy, zx}, {xy, hn::Add(yy, yy), yz}, {zx, yz, hn::Add(zz, zz)}};
    return add_scaled(scaled(shear, multiply(twice_strain, tet.own)), dilation, tet.own);
}

// As cpu::neo_hookean_force, divided by minus the volume.
HWY_INLINE Vector3 traction(Lanes d, const Pass<float>& pass, const TetLanes& tet, bool is_damped) {
    const Vector one = hn::Set(d, 1.0f), mu = tet.gradients[1].w, lambda = tet.gradients[2].w;
    Vector unused;
    const Matrix3 f = tet.gradient_of(d, pass.positions, unused);
    const Matrix3 cofactor{cross(f.y, f.z), cross(f.z, f.x), cross(f.x, f.y)};
    const Vector squares = hn::Add(dot(f.x, f.x), hn::Add(dot(f.y, f.y), dot(f.z, f.z)));
    const Vector shear = hn::Div(hn::Mul(mu, squares), hn::Add(squares, one));
    const Vector dilation = hn::Sub(dot(f.x, cofactor.x), one);
    const Vector pressure = hn::NegMulAdd(hn::Set(d, 0.75f), mu, hn::Mul(lambda, dilation));
    const Vector opening =
        hn::IfThenElseZero(hn::Lt(squares, hn::Set(d, static_cast<float>(kCollapsed))), hn::Neg(mu));
    Vector3 sum = add_scaled(scaled(shear, multiply(f, tet.own)), pressure, multiply(cofactor, tet.own));
    sum = add_scaled(sum, opening, tet.own);
    if (!is_damped) return sum;
    Vector damping;
    const Matrix3 rate = tet.gradient_of(d, pass.velocities, damping);
    const Vector share = hn::Div(damping, hn::Add(squares, one));  // the mean of four times the viscous share
    return add_scaled(sum, share, multiply(f, viscous_traction(d, f, rate, tet)));
}

// Adds the forces of their tets to those on the nodes first .. first + kLanes.
HWY_INLINE void add_tet_forces(Lanes d, const Pass<float>& pass, std::uint32_t first, Vector3& force) {
    const NodeTets& corners = pass.model.neo_hookean_corners;
    std::uint32_t most = 0;
    bool is_damped = false;
    for (std::uint32_t l = 0; l < kLanes; ++l) {
        most = std::max(most, corners.starts[first + l + 1] - corners.starts[first + l]);
        is_damped = is_damped || pass.velocities[first + l].w > 0.0f;
    }
    for (std::uint32_t k = 0; k < most; ++k) {
        std::uint32_t entries[kLanes];
        HWY_ALIGN float share[kLanes];  // 0 if the lane's node has no more tets
        for (std::uint32_t l = 0; l < kLanes; ++l) {
            const std::uint32_t e = corners.starts[first + l] + k;
            const bool exists = e < corners.starts[first + l + 1];
            entries[l] = exists ? corners.entries[e] : 0;
            share[l] = exists ? -1.0f : 0.0f;
        }
        const TetLanes tet(d, pass.model, entries);
        const Vector scale = hn::Mul(hn::Load(d, share), tet.gradients[0].w);
        force = add_scaled(force, scale, traction(d, pass, tet, is_damped));
    }
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
