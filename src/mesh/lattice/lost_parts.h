#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/lattice/enclosed_space.h"
#include "mesh/lattice/lattice.h"
#include "mesh/lattice/thin_parts.h"
#include "mesh/tet_mesh.h"

namespace gelatin::lattice {

/// The parts of the enclosed space that are in no tet, because it is too thin for the cells.
struct LostParts {
    double area_fraction = 0.0;  ///< of the surface
    double area = 0.0;           ///< of the surface [m^2]
    std::size_t pieces = 0;      ///< closed pieces of the surface that are lost as a whole
    glm::dvec3 where{0.0};       ///< in the thickest part [m]
    double cell_size =
        0.0;  ///< `CellSizes::boundary` that would keep all but the thinnest tenth [m]; 0: nothing is lost
};
LostParts find_lost_parts(const EnclosedSpace& space, ThinParts& thin, const CellSizes& sizes,
                          const TetMesh& mesh);

/// What becomes of pieces of the surface of which several sets of tets are made that no face joins.
struct Fragments {
    std::size_t removed = 0;  ///< sets that are removed: each along less than a fiftieth of its piece's area
    std::size_t divided = 0;  ///< pieces that are still divided among several sets
};
/// Removes such fragments of thin parts. A set belongs to the pieces of the surface whose faces it is closest
/// to, closer than `radius`.
Fragments remove_fragments(const EnclosedSpace& space, double radius, TetMesh& mesh);

}  // namespace gelatin::lattice
