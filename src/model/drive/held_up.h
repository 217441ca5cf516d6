#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "model/drive/handles.h"
#include "model/model.h"

namespace gelatin {

/// The handles with nodes that are farther from where their poses have them than contacts reach, each an
/// index in Model::handles. @param thicknesses of objects [m] @param positions w: inverse mass, shape [nodes]
/// @param places where handles have them [m], shape [Model::handle_nodes]
template <class Position>
std::vector<std::uint32_t> find_held_up(const Model& model, std::span<const double> thicknesses,
                                        std::span<const Position> positions,
                                        std::span<const glm::dvec3> places) {
    const double reach = *std::max_element(thicknesses.begin(), thicknesses.end());
    std::vector<std::uint8_t> are_late(model.handles.size());
    for (std::size_t h = 0; h < places.size(); ++h) {
        const HandleNode& held = model.handle_nodes[h];
        const Position& position = positions[held.node];
        if (position.w != 0) continue;  // it is released
        if (glm::distance(places[h], glm::dvec3(position)) > reach) are_late[held.handle] = 1;
    }
    std::vector<std::uint32_t> handles;
    for (std::uint32_t h = 0; h < are_late.size(); ++h)
        if (are_late[h] != 0) handles.push_back(h);
    return handles;
}

}  // namespace gelatin
