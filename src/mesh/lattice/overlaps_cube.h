#pragma once

#include "mesh/lattice/face_tree.h"

namespace gelatin::lattice {

/// Does a triangle share a point with the axis-parallel cube? By separating axes, with a little slack.
bool overlaps_cube(const Triangle& face, const glm::dvec3& center, double half_edge);

}  // namespace gelatin::lattice
