#include "picture/line_of_sight.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace gelatin {
namespace {

constexpr std::size_t kMostTargets = 48;
constexpr float kContact = 1e-3f;  // of the line: what is as near as that, the point lies on

bool passes(const glm::vec3& from, const glm::vec3& way, const render::Bounds& box) {
    float enter = 0.0f, leave = 1.0f;
    for (int k = 0; k < 3; ++k) {
        if (way[k] == 0.0f) {
            if (from[k] < box.min[k] || from[k] > box.max[k]) return false;
            continue;
        }
        const float a = (box.min[k] - from[k]) / way[k], b = (box.max[k] - from[k]) / way[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

// Whether the line crosses the triangle from its back to its front (Moeller and Trumbore).
bool comes_out(const glm::vec3& from, const glm::vec3& way, const glm::vec3* corners) {
    const glm::vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const glm::vec3 across = glm::cross(way, v);
    const float slope = -glm::dot(way, glm::cross(u, v));
    if (!(slope < 0.0f)) return false;
    const glm::vec3 start = from - corners[0], turned = glm::cross(start, u);
    const float a = glm::dot(start, across) / slope, b = glm::dot(way, turned) / slope;
    const float t = glm::dot(v, turned) / slope;
    return a >= 0.0f && b >= 0.0f && a + b <= 1.0f && t > kContact && t < 1.0f;
}

}  // namespace

LineOfSight::LineOfSight(std::span<const glm::vec3> bodies) {
    const std::size_t stride = bodies.size() / kMostTargets + 1;
    for (std::size_t p = stride / 2; p < bodies.size(); p += stride) targets_.push_back(bodies[p]);
}

void LineOfSight::add_surface(std::vector<glm::vec3> corners) {
    if (corners.empty()) return;
    render::Bounds bounds{corners[0], corners[0]};
    for (const glm::vec3& corner : corners) bounds.add(corner);
    surfaces_.push_back({std::move(corners), bounds});
}

bool LineOfSight::is_hidden(const glm::vec3& from, const glm::vec3& eye) const {
    const glm::vec3 way = eye - from;
    for (const Surface& surface : surfaces_) {
        if (!passes(from, way, surface.bounds)) continue;
        for (std::size_t c = 0; c + 2 < surface.corners.size(); c += 3)
            if (comes_out(from, way, &surface.corners[c])) return true;
    }
    return false;
}

float LineOfSight::seen_from(const glm::vec3& eye) const {
    if (targets_.empty()) return 1.0f;
    const auto hidden = std::count_if(targets_.begin(), targets_.end(),
                                      [&](const glm::vec3& p) { return is_hidden(p, eye); });
    return 1.0f - static_cast<float>(hidden) / static_cast<float>(targets_.size());
}

}  // namespace gelatin
