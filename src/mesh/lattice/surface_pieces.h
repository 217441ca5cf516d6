#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin::lattice {

/// The connected parts of a surface: faces that share vertices.
struct SurfacePieces {
    std::vector<std::uint32_t> of_face;  ///< the piece of each face, shape [faces]
    /// The diameter of a sphere with the same ratio of volume to area, 0 for pieces that are open [m], shape
    /// [pieces].
    std::vector<double> thickness;
};
SurfacePieces find_pieces(const SurfaceMesh& surface);

}  // namespace gelatin::lattice
