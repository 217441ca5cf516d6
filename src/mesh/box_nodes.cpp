#include "mesh/box_nodes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>

namespace gelatin {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

struct Builder {
    std::span<const BoxItem> items;
    std::uint32_t most_in_leaf;
    BoxNodes& tree;

    void add(std::uint32_t first, std::uint32_t count) {
        glm::dvec3 min(kFar), max(-kFar), least(kFar), most(-kFar);
        for (std::uint32_t k = first; k < first + count; ++k) {
            const BoxItem& item = items[tree.order[k]];
            min = glm::min(min, item.min);
            max = glm::max(max, item.max);
            least = glm::min(least, item.center);
            most = glm::max(most, item.center);
        }
        const std::size_t index = tree.nodes.size();
        tree.nodes.push_back({min, max, first, count, 0});
        if (count <= most_in_leaf) return;
        const glm::dvec3 extent = most - least;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        const auto begin = tree.order.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
            const double x = items[a].center[axis], y = items[b].center[axis];
            return x != y ? x < y : a < b;
        });
        add(first, half);
        tree.nodes[index].right = static_cast<std::uint32_t>(tree.nodes.size());
        add(first + half, count - half);
    }
};

}  // namespace

BoxItem box_item_of(std::span<const glm::dvec3> corners) {
    BoxItem item{glm::dvec3(kFar), glm::dvec3(-kFar), glm::dvec3(0.0)};
    for (const glm::dvec3& corner : corners) {
        item.min = glm::min(item.min, corner);
        item.max = glm::max(item.max, corner);
        item.center += corner;
    }
    item.center /= static_cast<double>(corners.size());
    return item;
}

BoxNodes::BoxNodes(std::span<const BoxItem> items, std::uint32_t most_in_leaf) : order(items.size()) {
    std::iota(order.begin(), order.end(), 0u);
    if (items.empty()) return;
    nodes.reserve(4 * items.size() / most_in_leaf + 1);
    Builder{items, most_in_leaf, *this}.add(0, static_cast<std::uint32_t>(items.size()));
}

}  // namespace gelatin
