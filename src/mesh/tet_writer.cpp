#include <fmt/core.h>

#include <cstdint>
#include <glm/common.hpp>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "mesh/tet_formats.h"

namespace gelatin {
namespace {

template <class... Arguments>
void append(std::string& out, fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(out), text, std::forward<Arguments>(arguments)...);
}

int attribute_of(const TetMesh& mesh, std::size_t tet) {
    return mesh.attributes.empty() ? 0 : mesh.attributes[tet];
}

// Numbers are the shortest that are read back exactly.
void append_positions(std::string& out, const TetMesh& mesh) {
    for (const glm::dvec3& p : mesh.positions) append(out, "{} {} {}\n", p.x, p.y, p.z);
}

std::pair<glm::dvec3, glm::dvec3> bounds(const TetMesh& mesh) {
    glm::dvec3 low(0.0), high(0.0);
    if (!mesh.positions.empty()) low = high = mesh.positions.front();
    for (const glm::dvec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {low, high};
}

}  // namespace

std::string format_tetgen_nodes(const TetMesh& mesh) {
    std::string out = fmt::format("{} 3 0 0\n", mesh.positions.size());
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        const glm::dvec3& p = mesh.positions[n];
        append(out, "{} {} {} {}\n", n, p.x, p.y, p.z);
    }
    return out;
}

std::string format_tetgen_tets(const TetMesh& mesh) {
    const bool has_attributes = !mesh.attributes.empty();
    std::string out = fmt::format("{} 4 {}\n", mesh.tets.size(), has_attributes ? 1 : 0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const glm::uvec4& tet = mesh.tets[t];
        append(out, "{} {} {} {} {}", t, tet[0], tet[1], tet[2], tet[3]);
        if (has_attributes) append(out, " {}", mesh.attributes[t]);
        out += "\n";
    }
    return out;
}

std::string format_tetgen_faces(const TetMesh& mesh) {
    std::string out = fmt::format("{} 0\n", mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        append(out, "{} {} {} {}\n", f, mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2]);
    }
    return out;
}

std::string format_medit(const TetMesh& mesh) {
    std::string out =
        fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices\n{}\n", mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) append(out, "{} {} {} 0\n", p.x, p.y, p.z);
    append(out, "Triangles\n{}\n", mesh.faces.size());
    for (const glm::uvec3& f : mesh.faces) append(out, "{} {} {} 0\n", f[0] + 1, f[1] + 1, f[2] + 1);
    append(out, "Tetrahedra\n{}\n", mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const glm::uvec4 tet = mesh.tets[t] + 1u;
        append(out, "{} {} {} {} {}\n", tet[0], tet[1], tet[2], tet[3], attribute_of(mesh, t));
    }
    return out + "End\n";
}

// One block of nodes. For each attribute one block of tets and one volume, which becomes its physical group.
std::string format_gmsh(const TetMesh& mesh) {
    std::map<int, std::vector<std::size_t>> tets_of;  // by attribute
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) tets_of[attribute_of(mesh, t)].push_back(t);
    const std::size_t nodes = mesh.positions.size(), volumes = tets_of.size();
    std::string out = fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 {}\n", volumes);
    const auto [low, high] = bounds(mesh);
    int volume = 0;
    for (const auto& [attribute, tets] : tets_of) {
        append(out, "{} {} {} {} {} {} {} {} 0\n", ++volume, low.x, low.y, low.z, high.x, high.y, high.z,
               attribute != 0 ? fmt::format("1 {}", attribute) : "0");
    }
    append(out, "$EndEntities\n$Nodes\n1 {0} 1 {0}\n3 1 0 {0}\n", nodes);
    for (std::size_t n = 1; n <= nodes; ++n) append(out, "{}\n", n);
    append_positions(out, mesh);
    append(out, "$EndNodes\n$Elements\n{0} {1} 1 {1}\n", volumes, mesh.tets.size());
    volume = 0;
    for (const auto& [attribute, tets] : tets_of) {
        append(out, "3 {} 4 {}\n", ++volume, tets.size());
        for (const std::size_t t : tets) {
            const glm::uvec4 tet = mesh.tets[t] + 1u;
            append(out, "{} {} {} {} {}\n", t + 1, tet[0], tet[1], tet[2], tet[3]);
        }
    }
    return out + "$EndElements\n";
}

std::string format_vtu(const TetMesh& mesh) {
    constexpr int kVtkTetra = 10;
    std::string out = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\">\n"
        "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n"
        "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
        mesh.positions.size(), mesh.tets.size());
    append_positions(out, mesh);
    out +=
        "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" "
        "format=\"ascii\">\n";
    for (const glm::uvec4& t : mesh.tets) append(out, "{} {} {} {}\n", t[0], t[1], t[2], t[3]);
    out += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
    for (std::size_t t = 1; t <= mesh.tets.size(); ++t) append(out, "{}\n", 4 * t);
    out += "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) append(out, "{}\n", kVtkTetra);
    out += "</DataArray>\n</Cells>\n";
    if (!mesh.attributes.empty()) {
        out += "<CellData>\n<DataArray type=\"Int32\" Name=\"attribute\" format=\"ascii\">\n";
        for (const int attribute : mesh.attributes) append(out, "{}\n", attribute);
        out += "</DataArray>\n</CellData>\n";
    }
    return out + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace gelatin
