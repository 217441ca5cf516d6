#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// An order of items in which items that are near each other are neighbours: they are divided recursively
/// into up to four parts of nearly equal size, by medians of the items' centres, down to four items.
/// order[place] = item.
std::vector<std::uint32_t> box_tree_order(std::span<const glm::dvec3> centers);

/// Puts faces in that order.
void arrange_faces(std::span<const glm::dvec3> positions, std::vector<glm::uvec3>& faces);

/// The number of steps after which an order of moving items is renewed.
constexpr int kOrderLifetime = 64;

/// Appends a tree over items in that order, whose numbers are `items`.
void append_box_tree(const Range& items, BoxTree& trees);

}  // namespace gelatin
