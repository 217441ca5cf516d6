#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// The modulus that each spring represents [Pa], shape [springs], in a body of several materials: Young's, or
/// the shear modulus, depending on `tet_moduli`.
///
/// Along an edge the tets around it share the load in parallel, so moduli are averaged, weighted by volume. A
/// link passes through tets in series, so compliances are averaged: those of the two tets at a face, those
/// around the surface edge that it crosses, or, if it spans more, those around both of its ends.
/// @param tet_moduli [Pa], > 0, shape [tets]
/// @param springs pairs of nodes, the first smaller
std::vector<double> spring_moduli(const TetMesh& mesh, const std::vector<double>& tet_moduli,
                                  const std::vector<glm::uvec2>& springs);

}  // namespace gelatin
