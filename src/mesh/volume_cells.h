#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "mesh/notes.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// What a cell of a file is. The corners of a pyramid or prism are those of its base in circular order, then
/// the tip, or those opposite to the base's in the same order, as VTK and Gmsh number them.
enum class CellShape : std::uint8_t {
    flat,     ///< a point, a line or a surface
    unknown,  ///< it has volume, but is none of the following
    tet,
    pyramid,
    wedge,
    hexahedron,
    pentagonal_prism,
    hexagonal_prism,
};

/// 0 of cells that do not become tets.
std::size_t corner_count(CellShape shape);

/// "tets", "hexahedra" and so on.
const char* plural_of(CellShape shape);

/// The cells of a mesh file, of any shape, which become tets.
///
/// Each side with more than three corners is cut at the diagonals from its corner of lowest index, so that
/// the tets of neighbours fit together, and the cell's corner of lowest index is connected to all triangles
/// that do not contain it (Dompierre et al. 1999, "How to subdivide pyramids, prisms and hexahedra into
/// tetrahedra"). Nodes that coincide have the same index. Where two tets of the file share a quadrilateral
/// with a cell, their common edge is the diagonal. A cell of which this gives a nearly flat or an inverted
/// tet gets a node at its centre, if that is better.
class VolumeCells {
public:
    std::vector<glm::dvec3> positions;  ///< of the file's nodes; may be set after the cells

    /// @param corners as many as corner_count(shape), indices into the later `positions`
    /// @param is_curved whether the cell has more nodes, which are ignored
    void add(CellShape shape, std::span<const std::uint32_t> corners, bool is_curved, int attribute);

    /// Cells that become no tets. @param kind names what is unknown, for the warning
    void add_other(CellShape shape, const std::string& kind, std::size_t count = 1);

    /// The tets of the file, then those of its other cells, each with its cell's attribute. Leaves nothing.
    /// @param file for messages
    /// @throws InvalidInput for cells of which no division has tets with a volume.
    TetMesh divide(const std::string& file, Notes& notes);

private:
    friend class CellDivision;
    struct Cell {
        std::size_t number;  ///< in the file, from 1
        std::size_t first;   ///< of its corners
        int attribute;
        CellShape shape;
    };
    std::vector<glm::uvec4> tets_;
    std::vector<int> tet_attributes_;
    std::vector<Cell> cells_;  ///< all others with corners
    std::vector<std::uint32_t> corners_;
    std::size_t count_ = 0, flat_ = 0, curved_ = 0;
    std::map<std::string, std::size_t> unknown_;  ///< by kind
};

}  // namespace gelatin
