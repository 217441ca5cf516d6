#include "sim/attachment_lines.h"

namespace gelatin {
namespace {

constexpr double kAxisLength = 0.7;  // either way, in Joint::lever

AttachedPoints points_of(const Tie& tie, const Range& own_nodes, std::span<const glm::vec4> positions) {
    AttachedPoints points{glm::dvec3(0.0), glm::dvec3(tie.at)};
    for (std::uint32_t k = 0; k < tie.count; ++k) {
        const std::uint32_t n = tie.nodes[k];
        const glm::dvec3 part = static_cast<double>(tie.weights[k]) * glm::dvec3(positions[n]);
        if (n >= own_nodes.first && n < own_nodes.end()) {
            points.own += part;
        } else {
            points.other -= part;
        }
    }
    return points;
}

void add_axes(const Joint& joint, const glm::dvec3& middle, std::span<const glm::vec4> positions,
              std::vector<OverlayLine>& lines) {
    if (joint.kind == Joint::Kind::none || joint.kind == Joint::Kind::distance) return;
    const auto add = [&](const glm::dvec3& direction) {
        const glm::dvec3 arm = kAxisLength * joint.lever * direction;
        lines.push_back(line_of(OverlayLine::kAxis, middle - arm, middle + arm));
    };
    add(frame_of(joint.other, positions).axes[2]);
    if (joint.kind == Joint::Kind::universal) add(frame_of(joint.own, positions).axes[0]);
}

glm::dvec3 middle_of_own(std::span<const AttachedPoints> all) {
    glm::dvec3 sum(0.0);
    for (const AttachedPoints& points : all) sum += points.own;
    return sum / static_cast<double>(all.size());
}

}  // namespace

std::vector<AttachedPoints> attached_points(const Attachment& attachment, const Model& model,
                                            std::span<const glm::vec4> positions) {
    std::vector<AttachedPoints> points;
    for (const Tie& tie : attachment.ties)
        points.push_back(points_of(tie, model.objects[attachment.object].nodes, positions));
    if (points.empty() && attachment.joint.kind != Joint::Kind::none)
        points.push_back({frame_of(attachment.joint.own, positions).point,
                          frame_of(attachment.joint.other, positions).point});
    return points;
}

std::vector<OverlayLine> attachment_lines(std::span<const Attachment> attachments, const Model& model,
                                          std::span<const glm::vec4> positions) {
    std::vector<OverlayLine> lines;
    for (const Attachment& attachment : attachments) {
        if (attachment.is_broken) continue;
        const std::vector<AttachedPoints> all = attached_points(attachment, model, positions);
        add_axes(attachment.joint, middle_of_own(all), positions, lines);
        for (const AttachedPoints& points : all) {
            if (points.own != points.other)
                lines.push_back(line_of(OverlayLine::kBetween, points.own, points.other));
            lines.push_back(line_of(OverlayLine::kAttached, points.own, points.own));
            if (attachment.joint.kind == Joint::Kind::distance)
                lines.push_back(line_of(OverlayLine::kAttached, points.other, points.other));
        }
    }
    return lines;
}

}  // namespace gelatin
