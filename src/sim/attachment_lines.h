#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/drive/attachment.h"
#include "model/model.h"
#include "sim/overlay_line.h"

namespace gelatin {

/// Where an attachment's own side and its other side are at one moment [m]: of one tie, or of its joint.
struct AttachedPoints {
    glm::dvec3 own, other;
};

/// Of all ties; of a joint without ties, of its frames. @param positions of all nodes [m]
std::vector<AttachedPoints> attached_points(const Attachment& attachment, const Model& model,
                                            std::span<const glm::vec4> positions);

/// Points of those that are not broken, lines between their sides, and axes of their joints.
std::vector<OverlayLine> attachment_lines(std::span<const Attachment> attachments, const Model& model,
                                          std::span<const glm::vec4> positions);

}  // namespace gelatin
