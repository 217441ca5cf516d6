#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin {

/// Where objects are that overlapped.
struct MovedApart {
    std::vector<glm::vec4> positions;  ///< of all nodes: xyz [m], inverse mass
    std::vector<std::string> lines;    ///< to report: which objects overlapped, and how far they were moved
};

/// Moves bodies that overlap others, or colliders, as a whole until they are apart, each along the normals of
/// the faces that overlap, a little at a time. Lighter bodies move farther, and all go no deeper into
/// planes. Those of which a node is held stay, and so do colliders. Before that rigid bodies leave planes.
/// @param positions of all nodes
/// @param joined may overlap each other
/// @param when for the lines: "at the start"
/// @return none if nothing overlaps; where objects cannot be moved apart, or both stay, some still overlap
std::optional<MovedApart> move_apart(const std::shared_ptr<const Model>& model,
                                     std::span<const glm::vec4> positions, const JoinedBodies& joined = {},
                                     std::string_view when = "at the start");

}  // namespace gelatin
