#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gelatin/scene.h"
#include "model/drive/attachment.h"
#include "model/model.h"

namespace gelatin {

/// Finds objects that start so deep inside a collider that their nodes are not all pushed out on one side,
/// which tears them; one line for each collider. The limit is half of the object's thickness across the
/// collider's surface. Objects that start less deep are pushed out without damage.
/// @param positions of all nodes at the start: xyz [m]
std::vector<std::string> check_starts(const Model& model, const Scene& scene,
                                      std::span<const glm::vec4> positions);

/// @throws InvalidInput naming the two objects, if faces of two of them overlap @param when "at the start"
void require_apart(const std::shared_ptr<const Model>& model, const Scene& scene,
                   std::span<const glm::vec4> positions, const JoinedBodies& joined = {},
                   std::string_view when = "at the start");
/// One line for each body of which faces overlap that have no common corner. Contact keeps nodes from going
/// through faces, and edges through edges, whatever lies where: what passes through itself stays so, and no
/// more does.
std::vector<std::string> find_tangled(const std::shared_ptr<const Model>& model,
                                      std::span<const glm::vec4> positions,
                                      std::string_view when = "at the start");

}  // namespace gelatin
