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
/// @param poses shape [handles]
template <class Position>
std::vector<std::uint32_t> find_held_up(const Model& model, std::span<const double> thicknesses,
                                        std::span<const Position> positions,
                                        std::span<const HandlePose> poses) {
    const double reach = *std::max_element(thicknesses.begin(), thicknesses.end());
    std::vector<std::uint8_t> are_late(poses.size());
    for (const HandleNode& held : model.handle_nodes) {
        const Position& position = positions[held.node];
        if (position.w != 0) continue;  // it is released
        const glm::dvec3 place = poses[held.handle].place(glm::dvec3(held.arm));
        if (glm::distance(place, glm::dvec3(position)) > reach) are_late[held.handle] = 1;
    }
    std::vector<std::uint32_t> handles;
    for (std::uint32_t h = 0; h < are_late.size(); ++h)
        if (are_late[h] != 0) handles.push_back(h);
    return handles;
}

}  // namespace gelatin
