#include "item_boxes.h"

#include <cmath>
#include <optional>

namespace gelatin::viewer {
namespace {

glm::vec2 center(const ItemBox& box) {
    return 0.5f * (box.low + box.high);
}

}  // namespace

std::size_t next_item(std::span<const ItemBox> boxes, std::size_t from, Direction direction) {
    if (direction == Direction::left) return from == 0 ? 0 : from - 1;
    if (direction == Direction::right) return from + 1 < boxes.size() ? from + 1 : from;
    const float sign = direction == Direction::down ? 1.0f : -1.0f;
    const glm::vec2 here = center(boxes[from]);
    std::optional<std::size_t> best;
    glm::vec2 least{0.0f};  // distances of the best: to its row, then within it
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::vec2 there = center(boxes[i]);
        const float rows = sign * (there.y - here.y), across = std::abs(there.x - here.x);
        if (rows <= 1.0f) continue;  // in the same row, or behind
        const bool is_nearer_row = !best || rows < least.y - 1.0f;
        const bool is_nearer = !is_nearer_row && rows <= least.y + 1.0f && across < least.x;
        if (!is_nearer_row && !is_nearer) continue;
        best = i;
        least = {across, rows};
    }
    return best.value_or(from);
}

}  // namespace gelatin::viewer
