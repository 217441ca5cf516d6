#pragma once

#include "cpu/nodes.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Records in `alarm` the first step after which nodes are not finite, or have more kinetic energy than
/// `most_energy` each [J] (pinned nodes may have any speed). The record of an earlier step stays. GLSL twin:
/// shaders/sim/measure/watch_nodes.comp.
template <class Real>
void watch_nodes(const Nodes<Real>& nodes, std::uint32_t step_number, Real most_energy, Alarm& alarm);

}  // namespace gelatin::cpu
