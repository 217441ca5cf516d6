#pragma once

#include <cstddef>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// How many pairs of faces without a common vertex overlap, touching included, in double precision: none in
/// frames of bodies that do not pass through each other or themselves.
std::size_t count_crossings(const SurfaceMesh& mesh);

}  // namespace gelatin
