#include "model/collision/box_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace gelatin {
namespace {

constexpr std::uint32_t kNoRoot = 0xFFFFFFFFu;

// The number of items in each part that `count` items are divided into: four times a power of four, so that
// all leaves but the last are full.
std::size_t part_size(std::size_t count) {
    std::size_t size = BoxTree::kLeafItems;
    while (size * 4 < count) size *= 4;
    return size;
}

class Divider {
public:
    explicit Divider(std::span<const glm::dvec3> centers) : centers_(centers) {}

    void divide(std::span<std::uint32_t> items) const {
        if (items.size() > BoxTree::kLeafItems) halve(items, part_size(items.size()));
    }

private:
    // Halves at the boundary between two parts of `size`, until there is one part.
    void halve(std::span<std::uint32_t> items, std::size_t size) const {
        if (items.size() <= size) return divide(items);
        const std::size_t parts = (items.size() + size - 1) / size, half = parts / 2 * size;
        const int axis = longest_axis(items);
        std::nth_element(
            items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
            [&](std::uint32_t a, std::uint32_t b) { return centers_[a][axis] < centers_[b][axis]; });
        halve(items.first(half), size);
        halve(items.subspan(half), size);
    }

    int longest_axis(std::span<const std::uint32_t> items) const {
        glm::dvec3 min(std::numeric_limits<double>::infinity()), max(-min);
        for (const std::uint32_t item : items) {
            min = glm::min(min, centers_[item]);
            max = glm::max(max, centers_[item]);
        }
        const glm::dvec3 size = max - min;
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    std::span<const glm::dvec3> centers_;
};

// @return the number of levels of nodes below
std::uint32_t append_node(const Range& items, BoxTree& trees) {
    const auto node = static_cast<std::uint32_t>(trees.nodes.size());
    const bool is_leaf = items.count <= BoxTree::kLeafItems;
    trees.nodes.push_back({0, is_leaf ? items.first : 0, is_leaf ? items.count : 0, kNoRoot});
    std::uint32_t level = 0;
    const auto size = static_cast<std::uint32_t>(part_size(items.count));
    for (std::uint32_t first = items.first; !is_leaf && first < items.end(); first += size) {
        level = std::max(level, 1 + append_node({first, std::min(size, items.end() - first)}, trees));
    }
    trees.nodes[node].skip = static_cast<std::uint32_t>(trees.nodes.size());
    if (trees.levels.size() <= level) trees.levels.resize(level + 1);
    trees.levels[level].push_back(node);
    return level;
}

}  // namespace

std::vector<std::uint32_t> box_tree_order(std::span<const glm::dvec3> centers) {
    std::vector<std::uint32_t> order(centers.size());
    std::iota(order.begin(), order.end(), 0);
    Divider(centers).divide(order);
    return order;
}

void arrange_faces(std::span<const glm::dvec3> positions, std::vector<glm::uvec3>& faces) {
    std::vector<glm::dvec3> centers;
    for (const glm::uvec3& f : faces)
        centers.push_back((positions[f.x] + positions[f.y] + positions[f.z]) / 3.0);
    const std::vector<glm::uvec3> unordered = faces;
    std::size_t place = 0;
    for (const std::uint32_t face : box_tree_order(centers)) faces[place++] = unordered[face];
}

void append_box_tree(const Range& items, BoxTree& trees) {
    const auto tree = static_cast<std::uint32_t>(trees.roots.size());
    trees.roots.push_back(static_cast<std::uint32_t>(trees.nodes.size()));
    append_node(items, trees);
    trees.nodes[trees.roots.back()].root_of = tree;
}

}  // namespace gelatin
