#include "gpu/implicit/convex_bodies.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "model/corners.h"

namespace gelatin::gpu {
namespace {

struct ConvexTets {
    std::vector<glm::uvec4> tets;
    std::vector<std::uint32_t> bodies;
    std::vector<glm::vec4> inverses;  // columns
};

ConvexTets convex_tets_of(const Model& model, const std::vector<std::uint32_t>& are_convex) {
    ConvexTets all;
    for (std::uint32_t o = 0; o < model.body_count(); ++o) {
        const Range& tets = model.objects[o].tets;
        for (std::uint32_t t = tets.first; are_convex[o] != 0 && t < tets.end(); ++t) {
            const auto corner = [&](int k) { return glm::dvec3(model.positions[model.tets[t][k]]); };
            const glm::dvec3 a = corner(0);
            const glm::dmat3 inverse = glm::inverse(glm::dmat3(corner(1) - a, corner(2) - a, corner(3) - a));
            all.tets.push_back(model.tets[t]);
            all.bodies.push_back(o);
            for (int k = 0; k < 3; ++k) all.inverses.emplace_back(glm::vec3(inverse[k]), 0.0f);
        }
    }
    return all;
}

// Children come after their parents.
std::vector<Box> boxes_at_start(const Model& model) {
    const std::vector<TreeNode>& nodes = model.face_trees.nodes;
    std::vector<Box> boxes(nodes.size(), {glm::vec4(3.4e38f), glm::vec4(-3.4e38f)});
    for (auto n = static_cast<std::uint32_t>(nodes.size()); n-- > 0;) {
        const auto add = [&](const glm::vec4& low, const glm::vec4& high) {
            boxes[n] = {glm::min(boxes[n].min, low), glm::max(boxes[n].max, high)};
        };
        for (std::uint32_t f = nodes[n].first_item; f < nodes[n].first_item + nodes[n].item_count; ++f)
            for (const std::uint32_t corner : corners_of(model.faces[f]))
                add(model.positions[corner], model.positions[corner]);
        for (std::uint32_t child = n + 1; child < nodes[n].skip; child = nodes[child].skip)
            add(boxes[child].min, boxes[child].max);
    }
    return boxes;
}

}  // namespace

ConvexBodies::ConvexBodies(const Model& model, const ContactSurface& surface, bool own)
    : rotations_(3 * model.objects.size(), gl::TexelFormat::rgba32f),
      lost_boxes_(2 * model.objects.size(), gl::TexelFormat::rgba32ui) {
    std::vector<std::uint32_t> are_convex(model.objects.size());
    if (own) are_convex.assign(surface.is_convex.begin(), surface.is_convex.end());
    const ConvexTets all = convex_tets_of(model, are_convex);
    // Colliders never meet themselves: they are like what has lost nothing.
    std::fill(are_convex.begin() + static_cast<std::ptrdiff_t>(model.body_count()), are_convex.end(), 1u);
    tet_count = static_cast<std::uint32_t>(all.tets.size());
    convex_bodies_ = {are_convex, gl::TexelFormat::r32ui};
    tets_ = {all.tets, gl::TexelFormat::rgba32ui};
    tet_bodies_ = {all.bodies, gl::TexelFormat::r32ui};
    tet_inverses_ = {all.inverses, gl::TexelFormat::rgba32f};
    rest_positions_ = {model.positions, gl::TexelFormat::rgba32f};
    rest_boxes_ = {boxes_at_start(model), gl::TexelFormat::rgba32f};
}

void ConvexBodies::bind(const gl::Program& program) const {
    program.set("tet_count", tet_count);
    program.bind_declared("convex_bodies", convex_bodies_);
    program.bind_declared("convex_tets", tets_);
    program.bind_declared("tet_bodies", tet_bodies_);
    program.bind_declared("tet_inverses", tet_inverses_);
    program.bind_declared("rest_positions", rest_positions_);
    program.bind_declared("rest_boxes", rest_boxes_);
    rotations_.bind(program, "Rotations", "rotations");
    lost_boxes_.bind(program, "LostBoxes", "lost_boxes");
}

}  // namespace gelatin::gpu
