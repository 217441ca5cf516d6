#pragma once

#include <cstddef>

#include "mesh/surface_mesh.h"

namespace gelatin {

struct WindingRepair {
    std::size_t flipped_faces = 0;
    std::size_t contrary_edges = 0;  ///< edges whose two faces cannot be consistent, as on a Moebius strip
};

/// Flips faces so that neighbours across an edge of two faces have the same orientation, and each connected
/// part encloses a positive volume. A closed part that is completely inside an odd number of others is a
/// cavity and gets the opposite orientation.
/// @pre no face names a vertex twice
WindingRepair orient_faces_outward(SurfaceMesh& mesh);

}  // namespace gelatin
