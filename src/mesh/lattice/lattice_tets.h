#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/lattice/octree.h"

namespace gelatin::lattice {

/// The tets that fill a balanced octree: a body-centred lattice where neighbours have the same size, with
/// tets divided in two or four where they do not. Labelle and Shewchuk 2007, section 3.
struct LatticeTets {
    std::vector<std::uint64_t> points;                ///< keys of all corners, ascending
    std::vector<std::array<std::uint32_t, 4>> tets;   ///< indices of points; of either orientation
    std::vector<std::array<std::uint32_t, 2>> cells;  ///< the two leaves of each tet, of one size or two
};

/// @pre octree.balance() has been called
LatticeTets make_lattice_tets(const Octree& octree);

}  // namespace gelatin::lattice
