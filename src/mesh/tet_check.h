#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Tells in `notes` what is suspicious in tets that are not flat and the right way out: those that are nearly
/// flat, those that overlap a neighbour, as in a mesh that is tangled, and faces of more than two tets.
void check_tets(const TetMesh& mesh, Notes& notes);

/// Volume over that of a regular tet with the same longest edge, from 0 to 1.
double roundness(const std::array<glm::dvec3, 4>& corners);

}  // namespace gelatin
