#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cpu/collision/axis_box.h"
#include "model/model.h"

namespace gelatin::cpu {

/// Writes the boxes of a tree's nodes from those of its items.
template <class Real>
void update_tree_boxes(const BoxTree& trees, std::uint32_t root, std::span<const AxisBox<Real>> items,
                       std::vector<AxisBox<Real>>& boxes) {
    // From the last node to the first, because children come after their parents.
    for (std::uint32_t n = trees.nodes[root].skip; n-- > root;) {
        const TreeNode& node = trees.nodes[n];
        AxisBox<Real> box;
        for (std::uint32_t k = node.first_item; k < node.first_item + node.item_count; ++k) box.add(items[k]);
        for (std::uint32_t child = n + 1; child < node.skip; child = trees.nodes[child].skip)
            box.add(boxes[child]);
        boxes[n] = box;
    }
}

/// found(leaf) for each leaf whose box meets `box`, in the order of the items, in the tree with the root
/// `root`. `boxes` are those of all nodes of `trees`. GLSL twins: shaders/sim/collision/walk_trees.comp,
/// sim/collision/own_tree.glsl.
template <class Real, class Found>
void for_leaves_near(const BoxTree& trees, std::span<const AxisBox<Real>> boxes, std::uint32_t root,
                     const AxisBox<Real>& box, const Found& found) {
    const std::uint32_t end = trees.nodes[root].skip;
    for (std::uint32_t n = root; n < end;) {
        const bool near = meet(box, boxes[n]);
        if (near && trees.nodes[n].item_count > 0) found(n);
        n = near ? n + 1 : trees.nodes[n].skip;
    }
}

/// found(item) for each item in those leaves.
template <class Real, class Found>
void for_items_near(const BoxTree& trees, std::span<const AxisBox<Real>> boxes, std::uint32_t root,
                    const AxisBox<Real>& box, const Found& found) {
    for_leaves_near(trees, boxes, root, box, [&](std::uint32_t leaf) {
        const TreeNode& node = trees.nodes[leaf];
        for (std::uint32_t k = node.first_item; k < node.first_item + node.item_count; ++k) found(k);
    });
}

}  // namespace gelatin::cpu
