// The terms of elements with a node in each lane. Compiled once for each instruction set, like
// simd_columns-inl.h.
#if defined(GELATIN_CPU_NODE_TERMS) == defined(HWY_TARGET_TOGGLE)
#ifdef GELATIN_CPU_NODE_TERMS
#undef GELATIN_CPU_NODE_TERMS
#else
#define GELATIN_CPU_NODE_TERMS
#endif

#include "cpu/float_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gelatin::cpu::HWY_NAMESPACE {

#include "cpu/elasticity/node_terms.inl"

#include "cpu/elasticity/neo_hookean_terms.inl"

}  // namespace gelatin::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
