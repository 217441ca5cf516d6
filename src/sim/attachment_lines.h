#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin {

/// Where an attachment's own side and its other side are at one moment [m]: of one tie, or of its joint.
struct AttachedPoints {
    glm::dvec3 own, other;
};

/// Of all ties; of a joint without ties, of its frames. @param positions of all nodes [m]
std::vector<AttachedPoints> attached_points(const Attachment& attachment, const Model& model,
                                            std::span<const glm::vec4> positions);

/// A line of the overlay of attachments, as OverlayView::attachment_lines has it.
struct AttachmentLine {
    glm::vec4 from;  ///< xyz [m], what it is
    glm::vec4 to;    ///< xyz [m], 0
};

/// Points of those that are not broken, lines between their sides, and axes of their joints.
std::vector<AttachmentLine> attachment_lines(std::span<const Attachment> attachments, const Model& model,
                                             std::span<const glm::vec4> positions);

}  // namespace gelatin
