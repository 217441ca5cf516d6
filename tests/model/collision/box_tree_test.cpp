#include "model/collision/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

namespace gelatin {
namespace {

// Trees over 4 and over 214 items, the second not full.
const Range kItems[] = {{0, 4}, {4, 214}};

BoxTree make_two_trees() {
    BoxTree trees;
    for (const Range& items : kItems) append_box_tree(items, trees);
    return trees;
}

TEST(BoxTree, LeavesHoldEveryItemOnceInOrder) {
    const BoxTree trees = make_two_trees();
    for (std::size_t t = 0; t < 2; ++t) {
        const std::uint32_t root = trees.roots[t];
        EXPECT_EQ(trees.nodes[root].root_of, t);
        std::uint32_t next = kItems[t].first;
        for (std::uint32_t n = root; n < trees.nodes[root].skip; ++n) {
            const TreeNode& node = trees.nodes[n];
            if (node.item_count == 0) continue;
            EXPECT_EQ(node.skip, n + 1);
            EXPECT_EQ(node.first_item, next);
            EXPECT_EQ((next - kItems[t].first) % 4, 0u) << "leaf k has the items from 4 k on";
            next += node.item_count;
            EXPECT_TRUE(node.item_count == 4 || next == kItems[t].end());
        }
        EXPECT_EQ(next, kItems[t].end());
    }
    EXPECT_EQ(trees.nodes.size(), trees.nodes[trees.roots[1]].skip);
}

TEST(BoxTree, InnerNodesHaveTwoToFourChildrenOnLowerLevels) {
    const BoxTree tree = make_two_trees();
    std::vector<std::size_t> level_of(tree.nodes.size(), 99);
    std::size_t listed = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level) {
        for (const std::uint32_t n : tree.levels[level]) level_of[n] = level;
        listed += tree.levels[level].size();
    }
    EXPECT_EQ(listed, tree.nodes.size());
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
        std::size_t children = 0;
        for (std::uint32_t child = n + 1; child < tree.nodes[n].skip; child = tree.nodes[child].skip) {
            EXPECT_LT(level_of[child], level_of[n]);
            ++children;
        }
        EXPECT_EQ(children == 0, tree.nodes[n].item_count > 0);
        EXPECT_TRUE(children == 0 || (children >= 2 && children <= 4));
    }
}

TEST(BoxTree, OrderHasEveryItemOnceAndNeighboursTogether) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<glm::dvec3> centers(777);
    for (glm::dvec3& c : centers) c = {unit(random), unit(random), unit(random)};
    const std::vector<std::uint32_t> order = box_tree_order(centers);
    std::vector<std::uint32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t k = 0; k < sorted.size(); ++k) EXPECT_EQ(sorted[k], k);

    // Leaves of four of 777 in a unit cube: a cube of their share of the volume has edges of 0.17.
    double sum = 0.0;
    for (std::size_t k = 0; k + 4 <= order.size(); k += 4) {
        glm::dvec3 min(9.0), max(-9.0);
        for (std::size_t i = k; i < k + 4; ++i) {
            min = glm::min(min, centers[order[i]]);
            max = glm::max(max, centers[order[i]]);
        }
        sum += glm::length(max - min);
    }
    EXPECT_LT(sum / std::floor(777 / 4.0), 0.3);
}

}  // namespace
}  // namespace gelatin
