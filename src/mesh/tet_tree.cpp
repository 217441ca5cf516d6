#include "mesh/tet_tree.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

namespace gelatin {
namespace {

constexpr std::uint32_t kLeafTets = 4;
constexpr double kSlack = 1e-9;  // of weights, and of boxes over the extent

std::vector<BoxItem> items_of(const TetMesh& mesh) {
    std::vector<BoxItem> items;
    for (const glm::uvec4& t : mesh.tets) {
        items.push_back(box_item_of(
            std::array{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], mesh.positions[t.w]}));
    }
    return items;
}

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

TetTree::TetTree(const TetMesh& mesh) : mesh_(mesh), tree_(items_of(mesh), kLeafTets) {
    if (tree_.nodes.empty()) return;
    slack_ = kSlack * glm::distance(tree_.nodes[0].min, tree_.nodes[0].max);
}

std::optional<TetPoint> TetTree::find(const glm::dvec3& p) const {
    std::optional<TetPoint> found;
    if (tree_.nodes.empty()) return found;
    double deepest = -kSlack;
    std::array<std::uint32_t, BoxNodes::kDeepest> stack{0};
    for (std::size_t size = 1; size > 0;) {
        const std::uint32_t index = stack[--size];
        const BoxNode& node = tree_.nodes[index];
        if (glm::any(glm::lessThan(p, node.min - slack_)) || glm::any(glm::greaterThan(p, node.max + slack_)))
            continue;
        if (node.right != 0) {
            stack[size++] = node.right;
            stack[size++] = index + 1;
            continue;
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            const std::uint32_t tet = tree_.order[k];
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
