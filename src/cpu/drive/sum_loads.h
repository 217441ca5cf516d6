#pragma once

#include <span>
#include <vector>

#include "cpu/nodes.h"
#include "model/drive/loads.h"

namespace gelatin::cpu {

/// The force of all loads on each node that has any [N], pressures on faces as they lie at `positions`;
/// leaves the other nodes alone. GLSL twin: sim/drive/sum_loads.comp.
/// @param factors of each load @param forces shape [nodes]
template <class Real>
void sum_loads(const Loads& loads, std::span<const float> factors, const std::vector<Vec4<Real>>& positions,
               std::vector<Vec4<Real>>& forces);

}  // namespace gelatin::cpu
