// The formulas of elements with a node in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_ELEMENTS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_ELEMENTS
#undef GELATIN_CPU_ELEMENTS
#else
#define GELATIN_CPU_ELEMENTS
#endif

#include "cpu/float_lanes-inl.h"
#include "model/shared_constants.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

using thresholds::kFlattest, thresholds::kCollapsed;

#include "cpu/elasticity/elements.inl"

using TermLanes = NodeTerms<FloatLanes>;

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
