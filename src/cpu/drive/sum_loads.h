#pragma once

#include <span>
#include <vector>

#include "cpu/nodes.h"
#include "model/drive/loads.h"

namespace gelatin::cpu {

/// The force of all loads on each node that has any [N], with pressures on faces as deformed at `positions`.
/// Other nodes do not change. GLSL twin: sim/drive/sum_loads.comp.
/// @param factors of each load @param forces shape [nodes]
template <class Real>
void sum_loads(const Loads& loads, std::span<const float> factors, const std::vector<Vec4<Real>>& positions,
               std::vector<Vec4<Real>>& forces);

}  // namespace gelatin::cpu
