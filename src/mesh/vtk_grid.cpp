#include "mesh/vtk_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "core/counted.h"
#include "gelatin/error.h"
#include "mesh/load_bytes.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

using Kind = VtkType::Kind;

struct NamedType {
    std::string_view name;  // in lower case
    VtkType type;
};

// vtkIdType has 64 bits in memory, but 32 in legacy files.
constexpr std::array<NamedType, 23> kTypes = {{
    {"char", {Kind::signed_integer, 1}},
    {"unsigned_char", {Kind::unsigned_integer, 1}},
    {"short", {Kind::signed_integer, 2}},
    {"unsigned_short", {Kind::unsigned_integer, 2}},
    {"int", {Kind::signed_integer, 4}},
    {"unsigned_int", {Kind::unsigned_integer, 4}},
    {"long", {Kind::signed_integer, 8}},
    {"unsigned_long", {Kind::unsigned_integer, 8}},
    {"vtktypeint64", {Kind::signed_integer, 8}},
    {"vtktypeuint64", {Kind::unsigned_integer, 8}},
    {"vtkidtype", {Kind::signed_integer, 4}},
    {"float", {Kind::real, 4}},
    {"double", {Kind::real, 8}},
    {"int8", {Kind::signed_integer, 1}},
    {"uint8", {Kind::unsigned_integer, 1}},
    {"int16", {Kind::signed_integer, 2}},
    {"uint16", {Kind::unsigned_integer, 2}},
    {"int32", {Kind::signed_integer, 4}},
    {"uint32", {Kind::unsigned_integer, 4}},
    {"int64", {Kind::signed_integer, 8}},
    {"uint64", {Kind::unsigned_integer, 8}},
    {"float32", {Kind::real, 4}},
    {"float64", {Kind::real, 8}},
}};

// What Gelatin, ParaView, Gmsh and meshio call the regions of a mesh. Gelatin's frames name the object.
constexpr std::array<std::string_view, 10> kAttributeNames = {
    "attribute", "material",      "material_id",   "materialids", "region",
    "regionid",  "gmsh:physical", "cellentityids", "medit:ref",   "object"};

struct VtkCellTypes {
    CellShape shape;
    std::array<std::int64_t, 14> numbers;  // first that of cells without nodes besides their corners
};

// vtkCellType.h. Corners come first, in the order of CellShape but for voxels.
constexpr std::int64_t kVoxel = 11, kLastFlat = 9;
constexpr std::array<VtkCellTypes, 7> kCellTypes = {{
    {CellShape::tet, {10, 24, 71, 79}},
    {CellShape::pyramid, {14, 27, 37, 74, 82}},
    {CellShape::wedge, {13, 26, 31, 32, 73, 81}},
    {CellShape::hexahedron, {12, 25, 29, 33, 72, 80}},
    {CellShape::pentagonal_prism, {15}},
    {CellShape::hexagonal_prism, {16}},
    {CellShape::flat, {21, 22, 23, 28, 30, 34, 35, 36, 68, 69, 70, 75, 76, 77}},
}};

struct VtkCellType {
    CellShape shape;
    bool is_curved;
};

VtkCellType find_cell_type(std::int64_t number) {
    if (number >= 0 && number <= kLastFlat) return {CellShape::flat, true};
    if (number == kVoxel) return {CellShape::hexahedron, false};
    for (const auto& [shape, numbers] : kCellTypes) {
        if (std::find(numbers.begin(), numbers.end(), number) != numbers.end())
            return {shape, number != numbers.front()};
    }
    return {CellShape::unknown, true};
}

template <class Stored, class T>
T load_as(std::string_view bytes, std::size_t offset, bool swapped) {
    return static_cast<T>(load_bytes<Stored>(bytes, offset, swapped));
}

}  // namespace

std::optional<VtkType> find_vtk_type(std::string_view name) {
    const std::string lower = lower_case(name);
    for (const NamedType& known : kTypes) {
        if (known.name == lower) return known.type;
    }
    return {};
}

template <class T>
T load_vtk_number(VtkType type, std::string_view bytes, std::size_t offset, bool swapped) {
    const bool has_sign = type.kind == Kind::signed_integer;
    if (type.kind == Kind::real) {
        return type.size == 4 ? load_as<float, T>(bytes, offset, swapped)
                              : load_as<double, T>(bytes, offset, swapped);
    }
    switch (type.size) {
        case 1:
            return has_sign ? load_as<std::int8_t, T>(bytes, offset, swapped)
                            : load_as<std::uint8_t, T>(bytes, offset, swapped);
        case 2:
            return has_sign ? load_as<std::int16_t, T>(bytes, offset, swapped)
                            : load_as<std::uint16_t, T>(bytes, offset, swapped);
        case 4:
            return has_sign ? load_as<std::int32_t, T>(bytes, offset, swapped)
                            : load_as<std::uint32_t, T>(bytes, offset, swapped);
        default:
            return has_sign ? load_as<std::int64_t, T>(bytes, offset, swapped)
                            : load_as<std::uint64_t, T>(bytes, offset, swapped);
    }
}
template double load_vtk_number(VtkType, std::string_view, std::size_t, bool);
template std::int64_t load_vtk_number(VtkType, std::string_view, std::size_t, bool);

std::optional<std::size_t> attribute_rank(std::string_view name) {
    const auto found = std::find(kAttributeNames.begin(), kAttributeNames.end(), lower_case(name));
    if (found == kAttributeNames.end()) return {};
    return static_cast<std::size_t>(found - kAttributeNames.begin());
}

void VtkCells::add(const VtkGrid& grid, int line) {
    const auto refuse = [&](const std::string& field, const std::string& value, const std::string& problem) {
        throw InvalidInput({file_.string(), line, field, value, problem});
    };
    const std::size_t cells = grid.types.size();
    if (grid.ends.size() != cells) {
        refuse("number of cell types", fmt::format("{}", cells),
               fmt::format("must be the number of cells, {}", grid.ends.size()));
    }
    std::vector<glm::dvec3>& positions = cells_.positions;
    const auto first_point = static_cast<std::uint32_t>(positions.size());
    std::vector<std::uint32_t> corners;
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
        const std::int64_t end = grid.ends[c];
        const auto cell = [&] { return fmt::format("cell {}", c + 1); };
        if (end < begin || end > static_cast<std::int64_t>(grid.connectivity.size())) {
            refuse("end of " + cell(), fmt::format("{}", end),
                   fmt::format("must be from {} to {}", begin, grid.connectivity.size()));
        }
        const std::int64_t first = std::exchange(begin, end), size = end - first;
        const VtkCellType type = find_cell_type(grid.types[c]);
        const auto needed = static_cast<std::int64_t>(corner_count(type.shape));
        if (needed == 0) {
            cells_.add_other(type.shape, fmt::format("VTK's cell type {}", grid.types[c]));
            continue;
        }
        if (size < needed || (size > needed && !type.is_curved)) {
            refuse(cell(), counted(size, "point"),
                   fmt::format("{} must have {}, curved ones more", plural_of(type.shape), needed));
        }
        corners.clear();
        for (std::int64_t k = first; k < first + needed; ++k) {
            const std::int64_t point = grid.connectivity[static_cast<std::size_t>(k)];
            if (point < 0 || point >= static_cast<std::int64_t>(grid.points.size())) {
                refuse(cell(), fmt::format("{}", point),
                       fmt::format("there is no point of this number; there are {}, counted from 0",
                                   grid.points.size()));
            }
            corners.push_back(first_point + static_cast<std::uint32_t>(point));
        }
        if (grid.types[c] == kVoxel) {  // rows, not circles
            std::swap(corners[2], corners[3]);
            std::swap(corners[6], corners[7]);
        }
        const std::int64_t attribute = grid.attributes.empty() ? 0 : grid.attributes[c];
        if (attribute != static_cast<int>(attribute))
            refuse("attribute of " + cell(), fmt::format("{}", attribute), "must fit into 32 bits");
        cells_.add(type.shape, corners, size > needed, static_cast<int>(attribute));
    }
    positions.insert(positions.end(), grid.points.begin(), grid.points.end());
}

}  // namespace gelatin
