#include "mesh/lattice/face_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace gelatin::lattice {
namespace {

constexpr std::uint32_t kLeafFaces = 8;
constexpr std::size_t kDeepest = 64;  // of a stack of nodes: halves of at most 2^32 faces

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

bool overlaps_segment(const FaceTree::Node& node, const glm::dvec3& a, const glm::dvec3& d) {
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

double squared_distance(const FaceTree::Node& node, const glm::dvec3& p) {
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

// Splits at the median along the longest axis of the box of the faces' centres.
struct FaceTree::Builder {
    FaceTree& tree;
    std::vector<std::uint32_t> order;
    std::vector<Triangle> faces;

    glm::dvec3 center(std::uint32_t face) const {
        return (faces[face][0] + faces[face][1] + faces[face][2]) / 3.0;
    }

    void add_node(std::uint32_t first, std::uint32_t count) {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        glm::dvec3 min(kFar), max(-kFar), least(kFar), most(-kFar);
        for (std::uint32_t k = first; k < first + count; ++k) {
            for (const glm::dvec3& corner : faces[order[k]]) {
                min = glm::min(min, corner);
                max = glm::max(max, corner);
            }
            least = glm::min(least, center(order[k]));
            most = glm::max(most, center(order[k]));
        }
        const std::size_t index = tree.nodes_.size();
        tree.nodes_.push_back({min, max, first, count, 0});
        if (count <= kLeafFaces) return;
        const glm::dvec3 extent = most - least;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        const auto begin = order.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            const double x = center(a)[axis], y = center(b)[axis];
            return x != y ? x < y : a < b;
        });
        add_node(first, half);
        tree.nodes_[index].right = static_cast<std::uint32_t>(tree.nodes_.size());
        add_node(first + half, count - half);
    }
};

FaceTree::FaceTree(const SurfaceMesh& surface) {
    Builder builder{*this, std::vector<std::uint32_t>(surface.faces.size()), {}};
    std::iota(builder.order.begin(), builder.order.end(), 0u);
    for (const glm::uvec3& f : surface.faces)
        builder.faces.push_back({surface.positions[f[0]], surface.positions[f[1]], surface.positions[f[2]]});
    if (surface.faces.empty()) return;
    builder.add_node(0, static_cast<std::uint32_t>(surface.faces.size()));
    for (const std::uint32_t face : builder.order) faces_.push_back(builder.faces[face]);
    sources_ = std::move(builder.order);
}

void FaceTree::find_crossings(const glm::dvec3& a, const glm::dvec3& b, std::vector<Crossing>& found) const {
    found.clear();
    if (nodes_.empty()) return;
    const glm::dvec3 d = b - a;
    std::array<std::uint32_t, kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
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
    if (nodes_.empty()) return nearest;
    double best = radius * radius;
    std::array<std::uint32_t, kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        if (squared_distance(node, p) >= best) continue;
        if (node.right != 0) {  // the nearer child first
            const bool left_first =
                squared_distance(nodes_[index + 1], p) <= squared_distance(nodes_[node.right], p);
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
