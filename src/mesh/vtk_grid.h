#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/tet_mesh.h"
#include "mesh/volume_cells.h"

namespace gelatin {

/// How VTK's files store a number.
struct VtkType {
    enum class Kind { signed_integer, unsigned_integer, real };
    Kind kind;
    std::size_t size;  ///< bytes

    bool is_integer() const { return kind != Kind::real; }
};

/// By the name in a legacy file ("unsigned_char") or in XML ("UInt8"); none if it is not one of numbers.
std::optional<VtkType> find_vtk_type(std::string_view name);

/// The number whose bytes begin at `offset`. An integer of 64 bits without sign may become negative.
template <class T>
T load_vtk_number(VtkType type, std::string_view bytes, std::size_t offset, bool swapped);

/// An unstructured grid as VTK's files have it; nothing is checked yet.
struct VtkGrid {
    std::vector<glm::dvec3> points;          ///< shape [points]
    std::vector<std::int64_t> types;         ///< VTK's numbers of cell types, shape [cells]
    std::vector<std::int64_t> ends;          ///< of each cell in `connectivity`, shape [cells]
    std::vector<std::int64_t> connectivity;  ///< indices into `points`
    std::vector<std::int64_t> attributes;    ///< shape [cells], or empty
};

/// Whether a cell array of this name, if it has integers, is the tets' attribute. The lowest rank is used.
std::optional<std::size_t> attribute_rank(std::string_view name);

/// Collects the cells of the grids of a file.
class VtkCells {
public:
    /// Keeps a reference to it, for messages.
    explicit VtkCells(const std::filesystem::path& file) : file_(file) {}

    /// @param line where the cells are, for messages; 0: unknown
    /// @throws InvalidInput for counts that do not agree and for indices out of range.
    void add(const VtkGrid& grid, int line);

    /// @throws as VolumeCells::divide
    TetMesh finish(Notes& notes) { return cells_.divide(file_.string(), notes); }

private:
    const std::filesystem::path& file_;
    VolumeCells cells_;
};

}  // namespace gelatin
