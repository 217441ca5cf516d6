#include "viewer/item_boxes.h"

#include <gtest/gtest.h>

#include <vector>

namespace gelatin::viewer {
namespace {

// Two short items in a line, and below them five cards in rows of three: 0 1 / 2 3 4 / 5 6.
std::vector<ItemBox> boxes() {
    return {{{0, 0}, {50, 20}},      {{60, 0}, {110, 20}},  {{0, 40}, {90, 100}},    {{100, 40}, {190, 100}},
            {{200, 40}, {290, 100}}, {{0, 110}, {90, 170}}, {{100, 110}, {190, 170}}};
}

TEST(ItemBoxes, LeftAndRightFollowTheOrder) {
    EXPECT_EQ(next_item(boxes(), 1, Direction::right), 2u);
    EXPECT_EQ(next_item(boxes(), 2, Direction::left), 1u);
    EXPECT_EQ(next_item(boxes(), 6, Direction::right), 6u);
    EXPECT_EQ(next_item(boxes(), 0, Direction::left), 0u);
}

TEST(ItemBoxes, UpAndDownGoToTheNearestOfTheNextRow) {
    EXPECT_EQ(next_item(boxes(), 0, Direction::down), 2u);
    EXPECT_EQ(next_item(boxes(), 1, Direction::down), 2u);
    EXPECT_EQ(next_item(boxes(), 3, Direction::down), 6u);
    EXPECT_EQ(next_item(boxes(), 4, Direction::down), 6u);
    EXPECT_EQ(next_item(boxes(), 4, Direction::up), 1u);
    EXPECT_EQ(next_item(boxes(), 5, Direction::up), 2u);
    EXPECT_EQ(next_item(boxes(), 6, Direction::down), 6u);
    EXPECT_EQ(next_item(boxes(), 1, Direction::up), 1u);
}

}  // namespace
}  // namespace gelatin::viewer
