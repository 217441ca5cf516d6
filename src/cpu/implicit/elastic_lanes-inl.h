// Columns of ElasticArrays as lanes. Compiled once for each instruction set, like cpu/simd_columns-inl.h.
#if defined(GELATIN_CPU_ELASTIC_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_ELASTIC_LANES
#undef GELATIN_CPU_ELASTIC_LANES
#else
#define GELATIN_CPU_ELASTIC_LANES
#endif

#include "cpu/elasticity/elements-inl.h"
#include "cpu/implicit/elastic_arrays.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

HWY_INLINE FloatLanes load(Lanes d, const FloatColumn& column, std::uint32_t row) {
    return hn::LoadU(d, &column[row]);
}

HWY_INLINE Vec3Lanes load(Lanes d, const std::array<FloatColumn, 3>& columns, std::uint32_t row) {
    return {load(d, columns[0], row), load(d, columns[1], row), load(d, columns[2], row)};
}

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
