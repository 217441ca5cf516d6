#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/lattice/enclosed_space.h"
#include "mesh/lattice/lattice_tets.h"
#include "mesh/lattice/octree.h"
#include "mesh/lattice/thin_parts.h"

namespace gelatin::lattice {

constexpr std::size_t kMostCells = 1'500'000;  // less than 2 GB of memory

/// Which sizes the cells of a lattice have.
struct CellSizes {
    double boundary;         ///< where the boundary passes [m], > 0
    int finer_levels = 2;    ///< at thin parts cells are halved this often at most
    int coarser_levels = 2;  ///< deep inside they are doubled this often at most
    std::size_t most_cells = kMostCells;
    std::size_t most_inside = kMostCells;  ///< points of the lattice that are inside
};

/// Thrown where a lattice would have more cells or points inside than `CellSizes` allows.
struct TooManyCells {};

/// A part is thin where cells are larger than this fraction of its thickness: then points of the lattice may
/// miss it.
constexpr double kCellsInThickness = 0.8;

/// The size of the smallest cells.
double smallest_cell(const CellSizes& sizes);

/// A lattice over the space that a surface encloses, and which of its points are inside.
struct Lattice {
    glm::dvec3 origin;  ///< of the octree's coordinates [m]
    double unit;        ///< of them [m]
    Octree octree;
    LatticeTets tets;
    std::vector<std::uint8_t> inside;  ///< 1: inside, shape [tets.points]

    glm::dvec3 position(const glm::ivec3& p) const { return origin + unit * glm::dvec3(p); }
    glm::dvec3 position(std::uint32_t point) const { return position(point_of(tets.points[point])); }
};

/// All tets that the boundary passes through are of cells of size `boundary`, or smaller at thin parts.
/// @throws TooManyCells
Lattice make_lattice(const EnclosedSpace& space, ThinParts& thin, const CellSizes& sizes);

}  // namespace gelatin::lattice
