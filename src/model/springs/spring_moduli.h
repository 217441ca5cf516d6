#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// The modulus that each spring stands for [Pa], shape [springs], in a body of several materials: Young's, or
/// the shear modulus, as `tet_moduli` has it.
///
/// Along an edge the tets round it share the load, so moduli have their mean, weighted by volume. A link
/// leads through one tet after the other, so compliances have it: of the two tets at a face, of those round
/// the edge of the surface that it crosses, or, where it spans more, of those round both of its ends.
/// @param tet_moduli [Pa], > 0, shape [tets]
/// @param springs pairs of nodes, the first smaller
std::vector<double> spring_moduli(const TetMesh& mesh, const std::vector<double>& tet_moduli,
                                  const std::vector<glm::uvec2>& springs);

}  // namespace gelatin
