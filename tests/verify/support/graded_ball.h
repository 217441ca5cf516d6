#pragma once

#include "mesh/surface_mesh.h"

namespace gelatin::test {

/// The surface of a ball about the origin, and surfaces inside that make a mesher fill it with small tets
/// near its lowest point and larger ones farther away.
/// @param edge length where it is finest: within a fifth of the radius [m]
SurfaceMesh make_graded_ball(double radius, double edge);

}  // namespace gelatin::test
