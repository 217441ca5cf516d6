#pragma once

#include <span>

#include "support/step_on_gpu.h"

namespace gelatin::test {

/// The model's start after the stage apply_kinematics on the GPU, guarded behind the nodes.
NodeArrays apply_kinematics_on_gpu(const Model& model, std::span<const HandleMotion> motions,
                                   std::span<const NodeMotion> animated);

/// The largest error of its nodes against the double reference, over a bound: a node's place is a sum of four
/// products, of at most the largest coordinate, its velocity of four, of at most the fastest. Infinite where
/// a mass is another, or a node that no handle holds is not as it was, bit for bit.
double worst_kinematics_error(const Model& model, std::span<const HandleMotion> motions,
                              std::span<const NodeMotion> animated, const NodeArrays& actual);

/// The forces of the model's loads on its nodes at the start by the GPU, of shape [nodes].
std::vector<glm::vec4> sum_loads_on_gpu(const Model& model, std::span<const float> factors);

/// The largest error against the double reference over a bound: each load is off by a few roundings of its
/// own size, a pressure's by those of the coordinates that it takes differences of.
double worst_load_error(const Model& model, std::span<const float> factors,
                        const std::vector<glm::vec4>& actual);

}  // namespace gelatin::test
