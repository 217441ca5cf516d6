#pragma once

#include <cstddef>

#include "mesh/surface_mesh.h"

namespace gelatin {

struct WindingRepair {
    std::size_t turned_faces = 0;
    std::size_t contrary_edges = 0;  ///< edges whose two faces cannot agree, as on a Moebius strip
};

/// Turns faces so that neighbours across an edge of two faces wind the same way, and each connected part
/// encloses a positive volume. A closed part that lies wholly inside an odd number of others is a cavity and
/// winds the other way.
/// @pre no face names a vertex twice
WindingRepair turn_faces_outward(SurfaceMesh& mesh);

}  // namespace gelatin
