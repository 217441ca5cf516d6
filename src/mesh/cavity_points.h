#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// For each piece of a closed surface that winds inwards, a point in the cavity that it bounds: far from all
/// faces, and in none of the bodies inside the cavity.
/// @pre each edge has two faces, of opposite directions, and faces do not cross
std::vector<glm::dvec3> find_cavity_points(const SurfaceMesh& surface);

}  // namespace gelatin
