#pragma once

#include "cpu/nodes.h"
#include "model/solver.h"

namespace gelatin::cpu {

/// Notes in `alarm` the first step after which nodes are not finite, or have more than `most_energy` of
/// kinetic energy each [J] (pinned ones are as fast as they like): what was noted of an earlier step stays.
/// GLSL twin: shaders/sim/measure/watch_nodes.comp.
template <class Real>
void watch_nodes(const Nodes<Real>& nodes, std::uint32_t step_number, Real most_energy, Alarm& alarm);

}  // namespace gelatin::cpu
