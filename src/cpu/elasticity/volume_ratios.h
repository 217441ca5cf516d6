#pragma once

#include <array>
#include <cstdint>

#include "cpu/elasticity/elements.h"
#include "cpu/nodes.h"
#include "model/elasticity/node_tets.h"
#include "model/model.h"

namespace gelatin::cpu {

/// 1 / (6 V) [1/m^3]
template <class Real>
Real inverse_six_volumes(const TetRest& rest) {
    return Real(1) / (Real(6) * static_cast<Real>(rest.volume));
}

/// True if all of these tets have between `least` and `most` of their volume at rest; in float with SIMD for
/// the present processor.
/// @param ratios output: their volume ratios, shape [tets.count], or null
bool volumes_are_within(float least, float most, const Model& model, const Range& tets,
                        const glm::vec4* positions, float* ratios);
bool volumes_are_within(double least, double most, const Model& model, const Range& tets,
                        const glm::dvec4* positions, double* ratios);

}  // namespace gelatin::cpu
