#include "mesh/tet_tree.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numeric>

namespace gelatin {
namespace {

constexpr std::uint32_t kLeafTets = 4;
constexpr std::size_t kDeepest = 64;  // of a stack of nodes: halves of at most 2^32 tets
constexpr double kSlack = 1e-9;       // of weights, and of boxes over the extent

double least_of(const glm::dvec4& w) {
    return std::min(std::min(w.x, w.y), std::min(w.z, w.w));
}

}  // namespace

glm::dvec4 barycentric(const TetMesh& mesh, const glm::uvec4& tet, const glm::dvec3& p) {
    const glm::dvec3& a = mesh.positions[tet.x];
    const glm::dvec3 ab = mesh.positions[tet.y] - a, ac = mesh.positions[tet.z] - a,
                     ad = mesh.positions[tet.w] - a, ap = p - a;
    const double volume = glm::dot(glm::cross(ab, ac), ad);
    const double b = glm::dot(glm::cross(ap, ac), ad) / volume;
    const double c = glm::dot(glm::cross(ab, ap), ad) / volume;
    const double d = glm::dot(glm::cross(ab, ac), ap) / volume;
    return {1.0 - b - c - d, b, c, d};
}

TetTree::TetTree(const TetMesh& mesh) : mesh_(mesh), order_(mesh.tets.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (order_.empty()) return;
    nodes_.reserve(order_.size());
    add_node(0, static_cast<std::uint32_t>(order_.size()));
    slack_ = kSlack * glm::distance(nodes_[0].min, nodes_[0].max);
}

glm::dvec3 TetTree::center(std::uint32_t tet) const {
    const glm::uvec4& t = mesh_.tets[tet];
    return 0.25 * (mesh_.positions[t.x] + mesh_.positions[t.y] + mesh_.positions[t.z] + mesh_.positions[t.w]);
}

// Splits at the median along the longest axis of the box of the tets' centres.
void TetTree::add_node(std::uint32_t first, std::uint32_t count) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    glm::dvec3 min(kFar), max(-kFar), least(kFar), most(-kFar);
    for (std::uint32_t k = first; k < first + count; ++k) {
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec3& p = mesh_.positions[mesh_.tets[order_[k]][corner]];
            min = glm::min(min, p);
            max = glm::max(max, p);
        }
        least = glm::min(least, center(order_[k]));
        most = glm::max(most, center(order_[k]));
    }
    const std::size_t index = nodes_.size();
    nodes_.push_back({min, max, first, count, 0});
    if (count <= kLeafTets) return;
    const glm::dvec3 extent = most - least;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        const double x = center(a)[axis], y = center(b)[axis];
        return x != y ? x < y : a < b;
    });
    add_node(first, half);
    nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
    add_node(first + half, count - half);
}

std::optional<TetPoint> TetTree::find(const glm::dvec3& p) const {
    std::optional<TetPoint> found;
    if (nodes_.empty()) return found;
    double deepest = -kSlack;
    std::array<std::uint32_t, kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        if (glm::any(glm::lessThan(p, node.min - slack_)) || glm::any(glm::greaterThan(p, node.max + slack_)))
            continue;
        if (node.right != 0) {
            stack[size++] = node.right;
            stack[size++] = index + 1;
            continue;
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            const std::uint32_t tet = order_[k];
            const glm::dvec4 weights = barycentric(mesh_, mesh_.tets[tet], p);
            const double least = least_of(weights);
            const bool is_first = found && least == deepest && tet < found->tet;
            if (!(least > deepest) && !is_first) continue;  // nor a flat tet's, which are not finite
            deepest = least;
            found = TetPoint{tet, weights};
        }
    }
    return found;
}

}  // namespace gelatin
