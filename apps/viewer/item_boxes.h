#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>

namespace gelatin::viewer {

/// Where an item of a list is drawn, y downwards [pixels].
struct ItemBox {
    glm::vec2 low{0.0f}, high{0.0f};
};

enum class Direction { left, right, up, down };

/// The item that an arrow key leads to: left and right in their order, up and down to the nearest in the next
/// row. `from` itself at the ends. @pre from < boxes.size()
std::size_t next_item(std::span<const ItemBox> boxes, std::size_t from, Direction direction);

}  // namespace gelatin::viewer
