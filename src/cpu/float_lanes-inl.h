// A float in each lane, as a scalar for formulas. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_FLOAT_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_FLOAT_LANES
#undef GELATIN_CPU_FLOAT_LANES
#else
#define GELATIN_CPU_FLOAT_LANES
#endif

#include <limits>

#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

struct FloatLanes {
    Vector v;

    FloatLanes() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): results of Highway's functions are such scalars
    HWY_INLINE FloatLanes(Vector value) : v(value) {}
    HWY_INLINE explicit FloatLanes(float value) : v(hn::Set(Lanes(), value)) {}

    HWY_INLINE FloatLanes& operator+=(FloatLanes b) {
        v = hn::Add(v, b.v);
        return *this;
    }
};
using LaneMask = decltype(hn::Lt(Vector(), Vector()));

HWY_INLINE FloatLanes operator+(FloatLanes a, FloatLanes b) {
    return hn::Add(a.v, b.v);
}
HWY_INLINE FloatLanes operator-(FloatLanes a, FloatLanes b) {
    return hn::Sub(a.v, b.v);
}
HWY_INLINE FloatLanes operator-(FloatLanes a) {
    return hn::Neg(a.v);
}
HWY_INLINE FloatLanes operator*(FloatLanes a, FloatLanes b) {
    return hn::Mul(a.v, b.v);
}
HWY_INLINE FloatLanes operator/(FloatLanes a, FloatLanes b) {
    return hn::Div(a.v, b.v);
}
HWY_INLINE LaneMask operator<(FloatLanes a, FloatLanes b) {
    return hn::Lt(a.v, b.v);
}
HWY_INLINE LaneMask operator>(FloatLanes a, FloatLanes b) {
    return hn::Gt(a.v, b.v);
}
/// a b + c
HWY_INLINE FloatLanes multiply_add(FloatLanes a, FloatLanes b, FloatLanes c) {
    return hn::MulAdd(a.v, b.v, c.v);
}
HWY_INLINE FloatLanes select(LaneMask condition, FloatLanes a, FloatLanes b) {
    return hn::IfThenElse(condition, a.v, b.v);
}
HWY_INLINE FloatLanes larger(FloatLanes a, FloatLanes b) {
    return hn::Max(a.v, b.v);
}
HWY_INLINE FloatLanes square_root(FloatLanes a) {
    return hn::Sqrt(a.v);
}

struct Vec3Lanes {
    FloatLanes x, y, z;

    Vec3Lanes() = default;
    HWY_INLINE explicit Vec3Lanes(FloatLanes all) : x(all), y(all), z(all) {}
    HWY_INLINE Vec3Lanes(FloatLanes first, FloatLanes second, FloatLanes third)
        : x(first), y(second), z(third) {}

    HWY_INLINE Vec3Lanes& operator+=(const Vec3Lanes& b);
    HWY_INLINE Vec3Lanes& operator-=(const Vec3Lanes& b);
};

HWY_INLINE Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vec3Lanes operator*(FloatLanes factor, const Vec3Lanes& v) {
    return {factor * v.x, factor * v.y, factor * v.z};
}
HWY_INLINE Vec3Lanes& Vec3Lanes::operator+=(const Vec3Lanes& b) {
    return *this = *this + b;
}
HWY_INLINE Vec3Lanes& Vec3Lanes::operator-=(const Vec3Lanes& b) {
    return *this = *this - b;
}
/// Component by component.
HWY_INLINE Vec3Lanes multiply_add(const Vec3Lanes& a, const Vec3Lanes& b, const Vec3Lanes& c) {
    return {multiply_add(a.x, b.x, c.x), multiply_add(a.y, b.y, c.y), multiply_add(a.z, b.z, c.z)};
}
/// factor a + b
HWY_INLINE Vec3Lanes multiply_add(FloatLanes factor, const Vec3Lanes& a, const Vec3Lanes& b) {
    return {multiply_add(factor, a.x, b.x), multiply_add(factor, a.y, b.y), multiply_add(factor, a.z, b.z)};
}
HWY_INLINE FloatLanes dot(const Vec3Lanes& a, const Vec3Lanes& b) {
    return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}
HWY_INLINE Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
    return {hn::MulSub(a.y.v, b.z.v, hn::Mul(a.z.v, b.y.v)), hn::MulSub(a.z.v, b.x.v, hn::Mul(a.x.v, b.z.v)),
            hn::MulSub(a.x.v, b.y.v, hn::Mul(a.y.v, b.x.v))};
}
/// Of positions, whose fourth components do not count.
HWY_INLINE Vec3Lanes difference(const Columns& a, const Columns& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

struct Mat3Lanes {
    Vec3Lanes columns[3];

    Mat3Lanes() = default;
    HWY_INLINE Mat3Lanes(const Vec3Lanes& x, const Vec3Lanes& y, const Vec3Lanes& z) : columns{x, y, z} {}

    HWY_INLINE const Vec3Lanes& operator[](int k) const { return columns[k]; }
};

HWY_INLINE Mat3Lanes operator+(const Mat3Lanes& a, const Mat3Lanes& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
HWY_INLINE Mat3Lanes operator-(const Mat3Lanes& a, const Mat3Lanes& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
HWY_INLINE Mat3Lanes operator*(FloatLanes factor, const Mat3Lanes& m) {
    return {factor * m[0], factor * m[1], factor * m[2]};
}
HWY_INLINE Vec3Lanes operator*(const Mat3Lanes& m, const Vec3Lanes& v) {
    return multiply_add(v.x, m[0], multiply_add(v.y, m[1], v.z * m[2]));
}

// The formulas' names for lanes.
template <class Real>
struct LaneTypes;
template <>
struct LaneTypes<FloatLanes> {
    using Vec3 = Vec3Lanes;
    using Mat3 = Mat3Lanes;
};
template <class Real>
using Vec3 = typename LaneTypes<Real>::Vec3;
template <class Real>
using Mat3 = typename LaneTypes<Real>::Mat3;
template <class Real>
constexpr float kEpsilon = std::numeric_limits<float>::epsilon();

// values[indices[l]] in each lane; faster than the processors' own gathers.
HWY_INLINE FloatLanes gather(Lanes d, const float* values, const std::uint32_t* indices) {
    HWY_ALIGN float lanes[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) lanes[l] = values[indices[l]];
    return hn::Load(d, lanes);
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
