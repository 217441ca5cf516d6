#pragma once

#include <cstddef>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

struct WindingRepair {
    std::size_t flipped_faces = 0;
    std::size_t contrary_edges = 0;   ///< edges whose two faces cannot be consistent, as on a Moebius strip
    std::size_t cavities = 0;         ///< closed pieces inside a body that bound its cavities
    std::size_t enclosed_bodies = 0;  ///< closed pieces inside cavities
    std::size_t overlapping_bodies = 0;  ///< closed pieces that are bodies inside a body
    std::vector<bool> is_enclosed;       ///< for each face, whether it is of an overlapping body
};

/// Flips faces so that neighbours across an edge of two faces have the same orientation, and each connected
/// piece encloses a positive volume, unless it is a cavity, which gets the opposite orientation.
///
/// A closed piece that is completely inside a body is a cavity if its orientation in the file is opposite to
/// that of the piece around it. With the same orientation it is a body that overlaps the other one; its faces
/// bound nothing. A piece inside a cavity is a body, whatever its orientation.
/// @pre no face names a vertex twice
WindingRepair orient_faces_outward(SurfaceMesh& mesh);

}  // namespace gelatin
