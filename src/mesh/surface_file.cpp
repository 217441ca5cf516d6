#include "mesh/surface_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/surface_check.h"
#include "mesh/surface_import.h"
#include "mesh/surface_repair.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

// Assimp reads comments and blank lines between the rows of an OFF file as rows.
std::string without_comments(const std::string& content) {
    std::string rows;
    for (std::size_t begin = 0; begin < content.size();) {
        const std::size_t end = std::min(content.find('\n', begin), content.size());
        const std::string_view line = std::string_view(content).substr(begin, end - begin);
        const std::string_view row = line.substr(0, line.find('#'));
        if (row.find_first_not_of(" \t\r\v\f") != std::string_view::npos) rows.append(row).append("\n");
        begin = end + 1;
    }
    return rows;
}

// Merges vertices with the same position. STL repeats each vertex for every face, and Assimp does the same
// with those of OBJ; glTF repeats them where texture coordinates differ.
void share_vertices(SurfaceMesh& mesh) {
    const auto order = [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec3 &p = mesh.positions[a], &q = mesh.positions[b];
        return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
    };
    std::vector<std::uint32_t> sorted(mesh.positions.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    std::sort(sorted.begin(), sorted.end(), order);
    std::vector<std::uint32_t> first(sorted.size());  // of those with the same position
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const bool same = k > 0 && mesh.positions[sorted[k]] == mesh.positions[sorted[k - 1]];
        first[sorted[k]] = same ? first[sorted[k - 1]] : sorted[k];
    }
    std::vector<std::uint32_t> new_index(sorted.size());
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < new_index.size(); ++v) {
        if (first[v] == v) {
            mesh.positions[kept] = mesh.positions[v];
            new_index[v] = kept++;
        } else {
            new_index[v] = new_index[first[v]];
        }
    }
    mesh.positions.resize(kept);
    for (glm::uvec3& face : mesh.faces) face = {new_index[face[0]], new_index[face[1]], new_index[face[2]]};
}

SurfaceMesh read_obj(const fs::path& file, const std::string& content, Notes& notes) {
    const ObjVertices vertices = check_obj(file, content);
    SurfaceMesh mesh = import_surface(file, ".obj", content, notes);
    share_vertices(mesh);
    if (vertices.used > mesh.positions.size()) {
        notes.push_back(
            fmt::format("merged vertices with the same position: {}", vertices.used - mesh.positions.size()));
    }
    if (vertices.count > vertices.used) {
        notes.push_back(fmt::format("discarded vertices without faces: {}", vertices.count - vertices.used));
    }
    return mesh;
}

SurfaceMesh read_stl(const fs::path& file, std::string content, Notes& notes) {
    check_stl(file, content);
    const std::size_t binary_size = binary_stl_size(file, content);
    if (binary_size > 0) content.resize(binary_size);  // Assimp refuses anything after it
    SurfaceMesh mesh = import_surface(file, ".stl", content, notes);
    share_vertices(mesh);
    return mesh;
}

SurfaceMesh read_unrepaired(const fs::path& file, const std::string& ending, const std::string& content,
                            Notes& notes) {
    if (ending == ".obj") return read_obj(file, content, notes);
    if (ending == ".stl") return read_stl(file, content, notes);
    if (ending == ".gltf" || ending == ".glb") {
        SurfaceMesh mesh = import_surface(file, ending, content, notes);
        share_vertices(mesh);
        return mesh;
    }
    if (ending == ".ply") {
        check_ply(file, content);
        return import_surface(file, ending, content, notes);
    }
    check_off(file, content);
    return import_surface(file, ending, without_comments(content), notes);
}

}  // namespace

bool is_surface_file(const fs::path& file) {
    constexpr std::array kEndings = {".obj", ".stl", ".ply", ".off", ".gltf", ".glb"};
    return std::find(kEndings.begin(), kEndings.end(), lower_case_ending(file)) != kEndings.end();
}

SurfaceMesh read_surface(const fs::path& file, Notes& notes) {
    const std::string ending = lower_case_ending(file);
    if (!is_surface_file(file)) {
        throw InvalidInput(
            {file.string(), 0, {}, {}, "a surface file must end in .obj, .stl, .ply, .off, .gltf or .glb"});
    }
    std::string content = read_file(file);
    if (content.starts_with("\xef\xbb\xbf"))
        content.erase(0, 3);  // a byte order mark, which Assimp reads as a word
    if (content.empty()) throw InvalidInput({file.string(), 0, {}, {}, "is empty"});
    SurfaceMesh mesh = read_unrepaired(file, ending, content, notes);
    if (mesh.faces.empty()) throw InvalidInput({file.string(), 0, {}, {}, "has no faces"});
    repair_surface(mesh, notes);
    if (mesh.faces.empty()) throw InvalidInput({file.string(), 0, {}, {}, "has no faces with an area"});
    return mesh;
}

}  // namespace gelatin
