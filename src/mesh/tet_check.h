#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Reports in `notes` what is suspicious in tets that are neither flat nor inverted: nearly flat tets, tets
/// that overlap a neighbour, as in a tangled mesh, and faces of more than two tets.
void check_tets(const TetMesh& mesh, Notes& notes);

/// Volume relative to that of a regular tet with the same longest edge, from 0 to 1.
double roundness(const std::array<glm::dvec3, 4>& corners);

}  // namespace gelatin
