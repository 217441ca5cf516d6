#include "mesh/vtk_grid.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string>
#include <utility>

#include "gelatin/error.h"
#include "mesh/load_bytes.h"

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

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

// Of VTK's cell types those that are tets; their corners come first.
constexpr int kTetra = 10;
bool is_tet(std::int64_t type) {
    constexpr int kQuadratic = 24, kLagrange = 71, kBezier = 79;
    return type == kTetra || type == kQuadratic || type == kLagrange || type == kBezier;
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

void VtkTets::add(const VtkGrid& grid, int line) {
    const auto refuse = [&](const std::string& field, const std::string& value, const std::string& problem) {
        throw InvalidInput({file_.string(), line, field, value, problem});
    };
    const std::size_t cells = grid.types.size();
    if (grid.ends.size() != cells) {
        refuse("number of cell types", fmt::format("{}", cells),
               fmt::format("but there are {} cells", grid.ends.size()));
    }
    const auto first_point = static_cast<std::uint32_t>(mesh_.positions.size());
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < cells; ++c) {
        const std::int64_t end = grid.ends[c];
        const auto cell = [&] { return fmt::format("cell {}", c + 1); };
        if (end < begin || end > static_cast<std::int64_t>(grid.connectivity.size())) {
            refuse("end of " + cell(), fmt::format("{}", end),
                   fmt::format("must be from {} to {}", begin, grid.connectivity.size()));
        }
        const std::int64_t first = std::exchange(begin, end), size = end - first;
        if (!is_tet(grid.types[c])) {
            ++skipped_;
            continue;
        }
        if (size < 4 || (size > 4 && grid.types[c] == kTetra))
            refuse(cell(), fmt::format("{} points", size), "a tet must have 4, a curved one more");
        curved_ += size > 4 ? 1 : 0;
        glm::uvec4 tet;
        for (int corner = 0; corner < 4; ++corner) {
            const std::int64_t point = grid.connectivity[static_cast<std::size_t>(first + corner)];
            if (point < 0 || point >= static_cast<std::int64_t>(grid.points.size())) {
                refuse(cell(), fmt::format("{}", point),
                       fmt::format("there is no point of this number; there are {}, counted from 0",
                                   grid.points.size()));
            }
            tet[corner] = first_point + static_cast<std::uint32_t>(point);
        }
        const std::int64_t attribute = grid.attributes.empty() ? 0 : grid.attributes[c];
        if (attribute != static_cast<int>(attribute))
            refuse("attribute of " + cell(), fmt::format("{}", attribute), "must fit into 32 bits");
        mesh_.tets.push_back(tet);
        mesh_.attributes.push_back(static_cast<int>(attribute));
    }
    mesh_.positions.insert(mesh_.positions.end(), grid.points.begin(), grid.points.end());
}

TetMesh VtkTets::finish(Notes& notes) {
    if (skipped_ > 0) notes.push_back(fmt::format("skipped cells that are not tets: {}", skipped_));
    if (curved_ > 0)
        notes.push_back(fmt::format("kept the corners only of tets with more nodes: {}", curved_));
    return std::move(mesh_);
}

}  // namespace gelatin
