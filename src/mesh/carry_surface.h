#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// A point that moves with a tet: it is at the sum of the nodes' positions, each with its weight.
struct CarriedVertex {
    glm::uvec4 nodes;
    glm::dvec4 weights;  ///< barycentric coordinates: they sum to 1; some are negative outside the tet
};

/// A surface whose vertices tets carry.
struct CarriedSurface {
    std::vector<CarriedVertex> vertices;  ///< in the order of the surface's
    double skin_to_hull = 0.0;            ///< largest distance of a vertex from the boundary of the tets [m]
    double hull_to_skin = 0.0;            ///< largest distance of a node of the boundary from the surface [m]
};

/// Binds each vertex of `skin` to a tet of `body`: to the one that contains it; outside all, to one at the
/// nearest face of their boundary, beyond which it continues the tet's motion. The result is the same for any
/// number of threads.
/// @param skin any triangles: open, crossing, without area; @param body has tets, none of them flat
CarriedSurface carry_surface(const SurfaceMesh& skin, const TetMesh& body);

}  // namespace gelatin
