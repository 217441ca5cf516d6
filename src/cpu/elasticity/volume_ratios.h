#pragma once

#include "cpu/nodes.h"
#include "model/model.h"

namespace gelatin::cpu {

/// True if all of these tets have between `least` and `most` of their volume at rest; with SIMD for the
/// present processor.
/// @param ratios output: their volume ratios, shape [tets of the model], or null
bool volumes_are_within(float least, float most, const Model& model, const Range& tets,
                        const glm::vec4* positions, float* ratios);

}  // namespace gelatin::cpu
