#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "model/model.h"

namespace gelatin {

/// Orders triangles such that those near one another are neighbours: recursively into up to four parts of
/// nearly equal size by medians of their centres, down to four triangles. `append_face_tree` builds its tree
/// on that order.
void arrange_faces(std::span<const glm::dvec3> positions, std::vector<glm::uvec3>& faces);

/// Appends the tree over the arranged faces `faces` of one object.
void append_face_tree(const Range& faces, FaceTree& tree);

}  // namespace gelatin
