#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// For each closed piece of a surface that winds inwards, a point in the cavity that it bounds: far from all
/// faces, and in none of the bodies inside the cavity, if faces do not cross.
std::vector<glm::dvec3> find_cavity_points(const SurfaceMesh& surface);

}  // namespace gelatin
