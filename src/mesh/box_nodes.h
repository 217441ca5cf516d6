#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace gelatin {

/// A node of a binary tree of boxes. Its items are contiguous in the tree's order.
struct BoxNode {
    glm::dvec3 min, max;
    std::uint32_t first, count;  ///< its items
    std::uint32_t right;         ///< index of its second child; the first is the next node; 0: a leaf
};

/// What a tree is made of: a box, and a center by which it is sorted.
struct BoxItem {
    glm::dvec3 min, max, center;
};
BoxItem box_item_of(std::span<const glm::dvec3> corners);

/// Splits items at the median along the longest axis of the box of their centers, down to `most_in_leaf`.
struct BoxNodes {
    BoxNodes(std::span<const BoxItem> items, std::uint32_t most_in_leaf);

    /// The most nodes that wait on a stack while the tree is searched: halves of at most 2^32 items.
    static constexpr std::size_t kDeepest = 64;

    std::vector<BoxNode> nodes;        ///< parents before their children; empty without items
    std::vector<std::uint32_t> order;  ///< of the items
};

}  // namespace gelatin
