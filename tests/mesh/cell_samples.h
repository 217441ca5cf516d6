#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/volume_cells.h"
#include "tet_file_fixture.h"

namespace gelatin {

struct CellSample {
    CellShape shape;
    std::vector<std::uint32_t> corners;
    int attribute;
};

/// A unit cube, half a cube beside it, and a pyramid of height 1 on it. They share sides.
inline const std::vector<glm::dvec3> kMixedNodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},    {0, 1, 0},
                                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1},    {0, 1, 1},
                                                    {2, 0, 0}, {2, 1, 0}, {0.5, 0.5, 2}};
inline const std::vector<CellSample> kMixedCells = {{CellShape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 7},
                                                    {CellShape::wedge, {1, 5, 8, 2, 6, 9}, 8},
                                                    {CellShape::pyramid, {4, 5, 6, 7, 10}, 9}};
constexpr double kMixedVolume = 1.0 + 0.5 + 1.0 / 3.0;

inline std::string mixed_coordinates(const char* end = "\n") {
    std::string text;
    for (const glm::dvec3& p : kMixedNodes) text += fmt::format("{} {} {}{}", p.x, p.y, p.z, end);
    return text;
}

/// Corners, counted from `first`.
inline std::string numbers_of(const CellSample& cell, std::uint32_t first = 0) {
    std::string text;
    for (const std::uint32_t corner : cell.corners) text += fmt::format("{} ", corner + first);
    return text;
}

inline std::string mixed_vtk() {
    std::string text =
        "# vtk DataFile Version 3.0\nmixed\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n" +
        mixed_coordinates() + "CELLS 3 22\n";
    for (const CellSample& cell : kMixedCells)
        text += fmt::format("{} {}\n", cell.corners.size(), numbers_of(cell));
    return text + "CELL_TYPES 3\n12 13 14\nCELL_DATA 3\nSCALARS material int\nLOOKUP_TABLE default\n7 8 9\n";
}

inline std::string mixed_vtu() {
    std::string connectivity;
    for (const CellSample& cell : kMixedCells) connectivity += numbers_of(cell);
    const auto array = [](const char* type, const char* name, const std::string& values) {
        return fmt::format("<DataArray type=\"{}\" {} format=\"ascii\">{}</DataArray>", type, name, values);
    };
    return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"11\" "
           "NumberOfCells=\"3\">"
           "<Points>" +
           array("Float64", "NumberOfComponents=\"3\"", mixed_coordinates(" ")) + "</Points><Cells>" +
           array("Int32", "Name=\"connectivity\"", connectivity) +
           array("Int32", "Name=\"offsets\"", "8 14 19") + array("UInt8", "Name=\"types\"", "12 13 14") +
           "</Cells><CellData>" + array("Int32", "Name=\"material\"", "7 8 9") +
           "</CellData></Piece></UnstructuredGrid></VTKFile>";
}

inline std::string mixed_medit() {
    std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n11\n" + mixed_coordinates(" 0\n");
    const char* keywords[] = {"Hexahedra", "Prisms", "Pyramids"};
    for (std::size_t k = 0; k < kMixedCells.size(); ++k)
        text += fmt::format("{}\n1\n{}{}\n", keywords[k], numbers_of(kMixedCells[k], 1),
                            kMixedCells[k].attribute);
    return text + "End\n";
}

constexpr int kGmshTypes[] = {5, 6, 7};

inline std::string mixed_gmsh2() {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n";
    for (std::size_t n = 0; n < kMixedNodes.size(); ++n)
        text += fmt::format("{} {} {} {}\n", n + 1, kMixedNodes[n].x, kMixedNodes[n].y, kMixedNodes[n].z);
    text += "$EndNodes\n$Elements\n3\n";
    for (std::size_t k = 0; k < kMixedCells.size(); ++k)
        text += fmt::format("{} {} 2 {} 1 {}\n", k + 1, kGmshTypes[k], kMixedCells[k].attribute,
                            numbers_of(kMixedCells[k], 1));
    return text + "$EndElements\n";
}

inline std::string mixed_gmsh2_binary(bool swapped) {
    Bytes bytes(swapped);
    bytes.text("$MeshFormat\n2.2 1 8\n").add(Ints{1}).text("\n$EndMeshFormat\n$Nodes\n11\n");
    for (std::size_t n = 0; n < kMixedNodes.size(); ++n) {
        bytes.add(Ints{static_cast<std::int32_t>(n + 1)});
        bytes.add(Doubles{kMixedNodes[n].x, kMixedNodes[n].y, kMixedNodes[n].z});
    }
    bytes.text("\n$EndNodes\n$Elements\n3\n");
    for (std::size_t k = 0; k < kMixedCells.size(); ++k) {
        bytes.add(Ints{kGmshTypes[k], 1, 2, static_cast<std::int32_t>(k + 1), kMixedCells[k].attribute, 1});
        for (const std::uint32_t corner : kMixedCells[k].corners)
            bytes.add(Ints{static_cast<std::int32_t>(corner + 1)});
    }
    return bytes.text("\n$EndElements\n").all();
}

inline std::string mixed_gmsh4() {
    std::string text =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 3\n1 0 0 0 1 1 1 1 7 0\n2 0 0 0 1 1 1 1 8 0\n"
        "3 0 0 0 1 1 1 1 9 0\n$EndEntities\n$Nodes\n1 11 1 11\n3 1 0 "
        "11\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n" +
        mixed_coordinates() + "$EndNodes\n$Elements\n3 3 1 3\n";
    for (std::size_t k = 0; k < kMixedCells.size(); ++k)
        text += fmt::format("3 {} {} 1\n{} {}\n", k + 1, kGmshTypes[k], k + 1, numbers_of(kMixedCells[k], 1));
    return text + "$EndElements\n";
}

inline std::string mixed_gmsh4_binary(bool swapped) {
    Bytes bytes(swapped);
    bytes.text("$MeshFormat\n4.1 1 8\n")
        .add(Ints{1})
        .text("\n$EndMeshFormat\n$Entities\n")
        .add(Sizes{0, 0, 0, 3});
    for (std::int32_t k = 1; k <= 3; ++k)
        bytes.add(Ints{k}).add(Doubles{0, 0, 0, 1, 1, 1}).add(Sizes{1}).add(Ints{6 + k}).add(Sizes{0});
    bytes.text("\n$EndEntities\n$Nodes\n").add(Sizes{1, 11, 1, 11}).add(Ints{3, 1, 0}).add(Sizes{11});
    for (std::uint64_t n = 1; n <= 11; ++n) bytes.add(Sizes{n});
    for (const glm::dvec3& p : kMixedNodes) bytes.add(Doubles{p.x, p.y, p.z});
    bytes.text("\n$EndNodes\n$Elements\n").add(Sizes{3, 3, 1, 3});
    for (std::size_t k = 0; k < kMixedCells.size(); ++k) {
        bytes.add(Ints{3, static_cast<std::int32_t>(k + 1), kGmshTypes[k]}).add(Sizes{1, k + 1});
        for (const std::uint32_t corner : kMixedCells[k].corners) bytes.add(Sizes{corner + 1});
    }
    return bytes.text("\n$EndElements\n").all();
}

}  // namespace gelatin
