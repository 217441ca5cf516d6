#pragma once

#include <glm/vec4.hpp>
#include <span>

#include "model/layouts.h"

namespace gelatin::cpu {

/// The energy of springs [J]. Positions in float: each spring in float with SIMD for the present processor,
/// which is as exact as positions are, and their sum in double.
double sum_spring_energies(std::span<const Spring> springs, const glm::vec4* positions);
double sum_spring_energies(std::span<const Spring> springs, const glm::dvec4* positions);

}  // namespace gelatin::cpu
