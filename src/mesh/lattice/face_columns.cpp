#include "mesh/lattice/face_columns.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <queue>
#include <utility>

namespace gelatin::lattice {
namespace {

struct Rectangle {
    glm::dvec2 min, max;

    std::array<Rectangle, 2> halves(int axis) const {
        std::array<Rectangle, 2> halves = {*this, *this};
        halves[0].max[axis] = halves[1].min[axis] = 0.5 * (min[axis] + max[axis]);
        return halves;
    }
    int longer_side() const { return max.x - min.x >= max.y - min.y ? 0 : 1; }
    double area() const { return (max.x - min.x) * (max.y - min.y); }
};

// Does a line along an edge separate the face from the rectangle? Touching is no separation.
bool is_beside(const Triangle& face, const Rectangle& rectangle) {
    const glm::dvec2 center = 0.5 * (rectangle.min + rectangle.max), half = rectangle.max - center;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 a(face[k]), edge = glm::dvec2(face[(k + 1) % 3]) - a, opposite(face[(k + 2) % 3]);
        const glm::dvec2 normal(-edge.y, edge.x);
        const double p = glm::dot(a - center, normal), q = glm::dot(opposite - center, normal);
        const double reach = (1.0 + 1e-9) * glm::dot(half, glm::abs(normal));
        if (std::min(p, q) > reach || std::max(p, q) < -reach) return true;
    }
    return false;
}

// How the edge from a to b adds to the winding number of a polygon about p in the plane: by where it crosses
// the ray from p along the first axis. An edge of two faces gets the same answer from both, up to the sign,
// so that no ray slips through between them. The crossing is clamped to both ends against rounding.
inline int crossing_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
    const bool is_up = b.y > p.y;
    if (is_up == (a.y > p.y)) return 0;
    const glm::dvec3 &low = is_up ? a : b, &high = is_up ? b : a;
    const double x = low.x + (p.y - low.y) / (high.y - low.y) * (high.x - low.x);
    const bool is_ahead = std::clamp(x, std::min(low.x, high.x), std::max(low.x, high.x)) > p.x;
    return !is_ahead ? 0 : is_up ? 1 : -1;
}

// A point on the ray over p, where that is known to cross the face.
bool is_above(const Triangle& face, const glm::dvec3& p) {
    const auto [lowest, highest] = std::minmax({face[0].z, face[1].z, face[2].z});
    if (lowest > p.z || highest <= p.z) return lowest > p.z;
    const glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    return glm::dot(normal, face[0] - p) * normal.z > 0.0;
}

}  // namespace

// Divides the rectangle that costs most, again and again: with as many faces as it has, and as many points in
// it as its area.
struct FaceColumns::Builder {
    static constexpr std::size_t kLeafFaces = 32, kListed = 16, kListedAtLeast = 10'000;
    static constexpr int kMostMisses = 2, kDeepest = 48;
    static constexpr double kWorthIt = 0.9;  // of the cost before

    struct Open {
        double cost;
        std::uint32_t node;
        Rectangle rectangle;
        std::vector<std::uint32_t> faces;
        int depth, misses;  // divisions, and the last of them that did not lower the cost
        bool operator<(const Open& other) const {
            return cost != other.cost ? cost < other.cost : node > other.node;
        }
    };

    FaceColumns& columns;
    std::vector<Open> open;  // a heap
    std::size_t listed = 0;

    void add(std::uint32_t node, const Rectangle& rectangle, std::vector<std::uint32_t> faces, int depth,
             int misses) {
        listed += faces.size();
        const double cost = rectangle.area() * static_cast<double>(faces.size());
        open.push_back({cost, node, rectangle, std::move(faces), depth, misses});
        std::push_heap(open.begin(), open.end());
    }

    void close(const Open& leaf) {
        Node& node = columns.nodes_[leaf.node];
        node.first = static_cast<std::uint32_t>(columns.listed_.size());
        for (const std::uint32_t face : leaf.faces) columns.listed_.push_back(list(face));
        node.end = static_cast<std::uint32_t>(columns.listed_.size());
    }

    Listed list(std::uint32_t face) const {
        const auto& [a, b, c] = columns.faces_[face];
        const auto up = [](double x) {
            return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::max());
        };
        const auto down = [](double x) {
            return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::lowest());
        };
        return {down(std::min({a.y, b.y, c.y})), up(std::max({a.y, b.y, c.y})), up(std::max({a.x, b.x, c.x})),
                up(std::max({a.z, b.z, c.z})), face};
    }

    using Lists = std::array<std::vector<std::uint32_t>, 2>;

    Lists divide(const Open& leaf, int axis) const {
        const std::array<Rectangle, 2> halves = leaf.rectangle.halves(axis);
        const double at = halves[0].max[axis];
        Lists faces;
        for (const std::uint32_t index : leaf.faces) {
            const Triangle& face = columns.faces_[index];
            const auto [low, high] = std::minmax({face[0][axis], face[1][axis], face[2][axis]});
            const bool is_in_both = low <= at && high >= at;
            if (low <= at && !(is_in_both && is_beside(face, halves[0]))) faces[0].push_back(index);
            if (high >= at && !(is_in_both && is_beside(face, halves[1]))) faces[1].push_back(index);
        }
        return faces;
    }

    static std::size_t count(const Lists& lists) { return lists[0].size() + lists[1].size(); }
    static bool is_worth_it(const Open& leaf, const Lists& lists) {
        return static_cast<double>(count(lists)) < 2.0 * kWorthIt * static_cast<double>(leaf.faces.size());
    }

    void build(const Rectangle& whole) {
        std::vector<std::uint32_t> all(columns.faces_.size());
        for (std::uint32_t f = 0; f < all.size(); ++f) all[f] = f;
        const std::size_t most = kListedAtLeast + kListed * all.size();
        columns.nodes_.emplace_back();
        add(0, whole, std::move(all), 0, 0);
        while (!open.empty()) {
            std::pop_heap(open.begin(), open.end());
            const Open leaf = std::move(open.back());
            open.pop_back();
            if (leaf.faces.size() <= kLeafFaces || leaf.depth == kDeepest || listed > most) {
                close(leaf);
                continue;
            }
            int axis = leaf.rectangle.longer_side();
            Lists faces = divide(leaf, axis);
            if (!is_worth_it(leaf, faces)) {
                Lists others = divide(leaf, 1 - axis);
                if (count(others) < count(faces)) {
                    axis = 1 - axis;
                    faces = std::move(others);
                }
            }
            const int misses = is_worth_it(leaf, faces) ? 0 : leaf.misses + 1;
            if (misses == kMostMisses) {
                close(leaf);
                continue;
            }
            const std::array<Rectangle, 2> halves = leaf.rectangle.halves(axis);
            const auto child = static_cast<std::uint32_t>(columns.nodes_.size());
            columns.nodes_[leaf.node] = {halves[0].max[axis], axis, child, 0, 0};
            columns.nodes_.resize(child + 2);
            listed -= leaf.faces.size();
            for (std::uint32_t side = 0; side < 2; ++side)
                add(child + side, halves[side], std::move(faces[side]), leaf.depth + 1, misses);
        }
    }
};

FaceColumns::FaceColumns(std::span<const Triangle> faces) {
    if (faces.empty()) return;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    glm::dvec3 min(kFar), max(-kFar), shadows(0.0);  // areas of the faces' boxes along each axis
    for (const Triangle& face : faces) {
        const glm::dvec3 low = glm::min(glm::min(face[0], face[1]), face[2]),
                         high = glm::max(glm::max(face[0], face[1]), face[2]), d = high - low;
        min = glm::min(min, low);
        max = glm::max(max, high);
        shadows += glm::dvec3(d.y * d.z, d.z * d.x, d.x * d.y);
    }
    axis_ = shadows.x <= shadows.y && shadows.x <= shadows.z ? 0 : shadows.y <= shadows.z ? 1 : 2;
    for (const Triangle& face : faces) faces_.push_back({turned(face[0]), turned(face[1]), turned(face[2])});
    Builder{*this, {}, 0}.build({glm::dvec2(turned(min)), glm::dvec2(turned(max))});
}

std::span<const FaceColumns::Listed> FaceColumns::faces_over(const glm::dvec3& p) const {
    if (nodes_.empty()) return {};
    std::uint32_t node = 0;
    while (nodes_[node].child != 0)
        node = nodes_[node].child + (p[nodes_[node].axis] > nodes_[node].at ? 1u : 0u);
    return std::span(listed_).subspan(nodes_[node].first, nodes_[node].end - nodes_[node].first);
}

int FaceColumns::winding_number(const glm::dvec3& point) const {
    const glm::dvec3 p = turned(point);
    int number = 0;
    for (const Listed& listed : faces_over(p)) {
        if (listed.high_z < p.z || listed.high_x < p.x || listed.high_y < p.y || listed.low_y > p.y) continue;
        const Triangle& face = faces_[listed.face];
        const auto& [a, b, c] = face;
        const int sign = crossing_of(a, b, p) + crossing_of(b, c, p) + crossing_of(c, a, p);
        if (sign != 0 && is_above(face, p)) number += sign;
    }
    return number;
}

}  // namespace gelatin::lattice
