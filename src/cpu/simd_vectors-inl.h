// Vectors of three components, one in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_SIMD_VECTORS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_SIMD_VECTORS
#undef GELATIN_CPU_SIMD_VECTORS
#else
#define GELATIN_CPU_SIMD_VECTORS
#endif

#include "cpu/simd_columns-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR

struct Vector3 {
    Vector x, y, z;
};

HWY_INLINE Vector3 subtract(const Columns& a, const Columns& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector dot(const Vector3& a, const Vector3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
    return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
            hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
// sum + factor v
HWY_INLINE Vector3 add_scaled(const Vector3& sum, Vector factor, const Vector3& v) {
    return {hn::MulAdd(factor, v.x, sum.x), hn::MulAdd(factor, v.y, sum.y), hn::MulAdd(factor, v.z, sum.z)};
}
HWY_INLINE Vector3 scaled(Vector factor, const Vector3& v) {
    return {hn::Mul(factor, v.x), hn::Mul(factor, v.y), hn::Mul(factor, v.z)};
}

#endif
}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
