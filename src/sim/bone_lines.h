#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/drive/handles.h"
#include "model/model.h"
#include "sim/overlay_line.h"

namespace gelatin {

/// The bones of a handle's skeleton, and its nodes; none where it has no skeleton.
/// @param time the handle's [s] @param positions of all nodes [m]
std::vector<OverlayLine> bone_lines(const Model& model, std::size_t handle, const HandlePose& pose,
                                    double time, std::span<const glm::vec4> positions);

}  // namespace gelatin
