#include "sim/bone_lines.h"

#include "model/drive/handle_animation.h"

namespace gelatin {

std::vector<OverlayLine> bone_lines(const Model& model, std::size_t handle, const HandlePose& pose,
                                    double time, std::span<const glm::vec4> positions) {
    const HandleAnimation* const animation = model.handles[handle].animation.get();
    if (animation == nullptr || animation->bones.empty()) return {};
    const std::vector<glm::dmat4> nodes = animation->motion->nodes_at(time);
    const auto place_of = [&](std::uint32_t node) {
        return pose.place(animation->map * glm::dvec3(nodes[node][3]) + animation->offset);
    };
    std::vector<OverlayLine> lines;
    for (const HandleNode& held : model.handle_nodes) {
        const glm::dvec3 place(positions[held.node]);
        if (held.handle == handle) lines.push_back(line_of(OverlayLine::kCarried, place, place));
    }
    for (const HandleAnimation::Bone& bone : animation->bones)  // over the nodes
        lines.push_back(line_of(OverlayLine::kBone, place_of(bone.from), place_of(bone.to)));
    return lines;
}

}  // namespace gelatin
