#pragma once

#include "cpu/nodes.h"
#include "cpu/scalars.h"
#include "model/shared_constants.h"

/// Formulas of elements in float and in double; cpu/elasticity/elements-inl.h has them for lanes.
namespace gelatin::cpu {

/// Below this fraction of its rest volume, a tet resists.
using thresholds::kFlattest;
/// A tet with I = F : F below this is nearly a point. It has no stress that would open it, and no direction
/// to open in, so it gets the pressure mu in its rest orientation.
using thresholds::kCollapsed;

#include "cpu/elasticity/elements.inl"

}  // namespace gelatin::cpu
