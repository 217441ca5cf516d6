#include "mesh/lattice/face_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace gelatin::lattice {
namespace {

Triangle triangle_of(const SurfaceMesh& surface, const glm::uvec3& face) {
    return {surface.positions[face[0]], surface.positions[face[1]], surface.positions[face[2]]};
}

std::vector<BoxItem> items_of(const SurfaceMesh& surface) {
    std::vector<BoxItem> items;
    for (const glm::uvec3& face : surface.faces) items.push_back(box_item_of(triangle_of(surface, face)));
    return items;
}

// The fraction of the segment a + t d at which it crosses the face. Möller and Trumbore 1997.
std::optional<double> cross(const Triangle& face, const glm::dvec3& a, const glm::dvec3& d) {
    constexpr double kSlack = 1e-12;  // no gaps between neighbours
    const glm::dvec3 e1 = face[1] - face[0], e2 = face[2] - face[0];
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return std::nullopt;
    const glm::dvec3 s = a - face[0];
    const double u = glm::dot(s, p) / determinant;
    if (!(u >= -kSlack && u <= 1.0 + kSlack)) return std::nullopt;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(d, q) / determinant;
    if (!(v >= -kSlack && u + v <= 1.0 + kSlack)) return std::nullopt;
    const double t = glm::dot(e2, q) / determinant;
    return t >= 0.0 && t <= 1.0 ? std::optional(t) : std::nullopt;
}

bool overlaps_segment(const BoxNode& node, const glm::dvec3& a, const glm::dvec3& d) {
    constexpr double kSlack = 1e-12;
    double from = 0.0, to = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) {
            if (a[axis] < node.min[axis] - kSlack || a[axis] > node.max[axis] + kSlack) return false;
            continue;
        }
        const double t1 = (node.min[axis] - kSlack - a[axis]) / d[axis];
        const double t2 = (node.max[axis] + kSlack - a[axis]) / d[axis];
        from = std::max(from, std::min(t1, t2));
        to = std::min(to, std::max(t1, t2));
    }
    return from <= to;
}

double squared_distance(const BoxNode& node, const glm::dvec3& p) {
    const glm::dvec3 d = p - glm::clamp(p, node.min, node.max);
    return glm::dot(d, d);
}

glm::dvec3 nearest_on_edge(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    const glm::dvec3 ab = b - a;
    const double squared = glm::dot(ab, ab);
    return squared == 0.0 ? a : a + std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) * ab;
}

}  // namespace

glm::dvec3 nearest_point(const Triangle& face, const glm::dvec3& p) {
    const auto& [a, b, c] = face;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double squared = glm::dot(normal, normal);
    const auto is_left_of = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
    };
    if (squared > 0.0 && is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a))
        return p - glm::dot(p - a, normal) / squared * normal;
    glm::dvec3 best = nearest_on_edge(a, b, p);
    for (const glm::dvec3& other : {nearest_on_edge(b, c, p), nearest_on_edge(c, a, p)}) {
        if (glm::distance(p, other) < glm::distance(p, best)) best = other;
    }
    return best;
}

FaceTree::FaceTree(const SurfaceMesh& surface, std::uint32_t faces_in_leaf)
    : tree_(items_of(surface), faces_in_leaf) {
    for (const std::uint32_t face : tree_.order) faces_.push_back(triangle_of(surface, surface.faces[face]));
}

void FaceTree::find_crossings(const glm::dvec3& a, const glm::dvec3& b, std::vector<Crossing>& found) const {
    found.clear();
    if (tree_.nodes.empty()) return;
    const glm::dvec3 d = b - a;
    std::array<std::uint32_t, BoxNodes::kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const BoxNode& node = tree_.nodes[index];
        if (!overlaps_segment(node, a, d)) continue;
        if (node.right != 0) {
            stack[size++] = node.right;
            stack[size++] = index + 1;
            continue;
        }
        for (std::uint32_t face = node.first; face < node.first + node.count; ++face) {
            if (const auto at = cross(faces_[face], a, d)) found.push_back({*at, face});
        }
    }
    std::sort(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) {
        return x.at != y.at ? x.at < y.at : x.face < y.face;
    });
}

std::optional<NearestPoint> FaceTree::find_nearest(const glm::dvec3& p, double radius) const {
    std::optional<NearestPoint> nearest;
    if (tree_.nodes.empty()) return nearest;
    double best = radius * radius;
    std::array<std::uint32_t, BoxNodes::kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const BoxNode& node = tree_.nodes[index];
        if (squared_distance(node, p) >= best) continue;
        if (node.right != 0) {  // the nearer child first
            const bool left_first =
                squared_distance(tree_.nodes[index + 1], p) <= squared_distance(tree_.nodes[node.right], p);
            stack[size++] = left_first ? node.right : index + 1;
            stack[size++] = left_first ? index + 1 : node.right;
            continue;
        }
        for (std::uint32_t face = node.first; face < node.first + node.count; ++face) {
            const glm::dvec3 candidate = nearest_point(faces_[face], p);
            const double squared = glm::dot(p - candidate, p - candidate);
            if (squared >= best) continue;
            best = squared;
            nearest = NearestPoint{candidate, face};
        }
    }
    return nearest;
}

}  // namespace gelatin::lattice
