#pragma once

#include <optional>
#include <string>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// Part of the key of cached tets. Increase it when the same surface gets other tets or notes.
constexpr int kLatticeVersion = 2;

/// The number of nodes where no size is set.
constexpr int kUsualNodes = 5000;

/// How fine a lattice is; one of these at most.
struct LatticeSize {
    std::optional<int> nodes;          ///< about so many, > 0; empty like all others: kUsualNodes
    std::optional<double> cell_size;   ///< of cells at the surface [m], > 0
    std::optional<double> max_volume;  ///< of a tet [m^3], > 0
};

/// Fills what a surface encloses with tetrahedra of a body-centred lattice
/// (docs/decisions/0032-lattice-mesher.md). The surface may have holes, cross itself, or have faces that are
/// flipped or there twice. Parts that are too thin are lost and reported in `notes`. The result is the same
/// for any number of threads.
/// @param name for messages: the object's or the file's
/// @throws InvalidInput if a position is not finite, if the surface encloses nothing, or nothing that the
/// size
///   can resolve, or if there would be too many cells
TetMesh fill_with_lattice(const SurfaceMesh& surface, const LatticeSize& size, const std::string& name,
                          Notes& notes);

}  // namespace gelatin
