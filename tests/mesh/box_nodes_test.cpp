#include "mesh/box_nodes.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/vector_relational.hpp>

#include "support/random_maker.h"

namespace gelatin {
namespace {

bool contains(const BoxNode& outer, const glm::dvec3& min, const glm::dvec3& max) {
    return glm::all(glm::lessThanEqual(outer.min, min)) && glm::all(glm::greaterThanEqual(outer.max, max));
}

TEST(BoxNodes, ContainTheirItemsAndAreHalvedDownToTheLeaves) {
    test::RandomMaker random(3);
    std::vector<BoxItem> items;
    for (int k = 0; k < 1001; ++k) {
        const glm::dvec3 a(random.uniform(0.0, 1.0), random.uniform(0.0, 2.0), random.uniform(0.0, 1.0));
        items.push_back(box_item_of(std::array{a, a + glm::dvec3(0.1, 0.0, 0.2)}));
    }
    const BoxNodes tree(items, 5);
    std::vector<int> uses(items.size(), 0);
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
        const BoxNode& node = tree.nodes[n];
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            const BoxItem& item = items[tree.order[k]];
            EXPECT_TRUE(contains(node, item.min, item.max));
            if (node.right == 0) ++uses[tree.order[k]];
        }
        if (node.right == 0) {
            EXPECT_LE(node.count, 5u);
            continue;
        }
        const BoxNode &left = tree.nodes[n + 1], &right = tree.nodes[node.right];
        EXPECT_EQ(left.count, node.count / 2);
        EXPECT_EQ(left.count + right.count, node.count);
    }
    EXPECT_EQ(uses, std::vector<int>(items.size(), 1));
    EXPECT_TRUE(BoxNodes({}, 5).nodes.empty());
}

}  // namespace
}  // namespace gelatin
