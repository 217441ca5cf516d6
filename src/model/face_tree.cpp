#include "model/face_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace gelatin {
namespace {

constexpr std::uint32_t kNoRoot = 0xFFFFFFFFu;

// Faces in each part that `count` faces are divided into: a power of four, so that all leaves but the last
// are full.
std::size_t part_size(std::size_t count) {
    std::size_t size = FaceTree::kLeafFaces;
    while (size * 4 < count) size *= 4;
    return size;
}

struct Item {
    glm::uvec3 face;
    glm::dvec3 center;
};

int longest_axis(std::span<const Item> items) {
    glm::dvec3 min(std::numeric_limits<double>::infinity()), max(-min);
    for (const Item& item : items) {
        min = glm::min(min, item.center);
        max = glm::max(max, item.center);
    }
    const glm::dvec3 size = max - min;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

void arrange(std::span<Item> items);

// Halves at the boundary between two parts of `size`, until there is one part.
void divide(std::span<Item> items, std::size_t size) {
    if (items.size() <= size) return arrange(items);
    const std::size_t parts = (items.size() + size - 1) / size, half = parts / 2 * size;
    const int axis = longest_axis(items);
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [axis](const Item& a, const Item& b) { return a.center[axis] < b.center[axis]; });
    divide(items.first(half), size);
    divide(items.subspan(half), size);
}

void arrange(std::span<Item> items) {
    if (items.size() > FaceTree::kLeafFaces) divide(items, part_size(items.size()));
}

// @return how many levels of nodes lie below, the node's own included
std::uint32_t append_node(const Range& faces, FaceTree& tree) {
    const auto node = static_cast<std::uint32_t>(tree.nodes.size());
    const bool is_leaf = faces.count <= FaceTree::kLeafFaces;
    tree.nodes.push_back({0, is_leaf ? faces.first : 0, is_leaf ? faces.count : 0, kNoRoot});
    std::uint32_t level = 0;
    const auto size = static_cast<std::uint32_t>(part_size(faces.count));
    for (std::uint32_t first = faces.first; !is_leaf && first < faces.end(); first += size) {
        level = std::max(level, 1 + append_node({first, std::min(size, faces.end() - first)}, tree));
    }
    tree.nodes[node].skip = static_cast<std::uint32_t>(tree.nodes.size());
    if (tree.levels.size() <= level) tree.levels.resize(level + 1);
    tree.levels[level].push_back(node);
    return level;
}

}  // namespace

void arrange_faces(std::span<const glm::dvec3> positions, std::vector<glm::uvec3>& faces) {
    std::vector<Item> items;
    for (const glm::uvec3& f : faces) {
        items.push_back({f, (positions[f.x] + positions[f.y] + positions[f.z]) / 3.0});
    }
    arrange(items);
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = items[f].face;
}

void append_face_tree(const Range& faces, FaceTree& tree) {
    const auto object = static_cast<std::uint32_t>(tree.roots.size());
    tree.roots.push_back(static_cast<std::uint32_t>(tree.nodes.size()));
    append_node(faces, tree);
    tree.nodes[tree.roots.back()].root_of = object;
}

}  // namespace gelatin
