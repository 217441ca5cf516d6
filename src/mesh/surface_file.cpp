#include "mesh/surface_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "core/counted.h"
#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/file_ending.h"
#include "mesh/foreign_file.h"
#include "mesh/local_origin.h"
#include "mesh/surface_polygons.h"
#include "mesh/surface_readers.h"
#include "mesh/surface_repair.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;

// Merges vertices with the same position. STL repeats each vertex for every face, glTF where texture
// coordinates or normals differ.
void share_vertices(SurfaceMesh& mesh) {
    constexpr std::uint32_t kEmpty = ~0u;
    std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), kEmpty);
    // Of the vertex that is kept for this position; its own, if it is the first.
    const auto find = [&](const glm::dvec3& p, std::uint32_t kept) {
        std::uint64_t hash = 0;
        for (const double c : {p.x, p.y, p.z}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;  // -0 is 0
            hash ^= hash >> 29;
        }
        for (std::size_t slot = hash;; ++slot) {
            std::uint32_t& entry = table[slot & (table.size() - 1)];
            if (entry == kEmpty) entry = kept;
            if (entry == kept || mesh.positions[entry] == p) return entry;
        }
    };
    std::vector<std::uint32_t> new_index;
    new_index.reserve(mesh.positions.size());
    std::uint32_t kept = 0;
    for (const glm::dvec3 p : mesh.positions) {
        new_index.push_back(find(p, kept));
        if (new_index.back() == kept) mesh.positions[kept++] = p;
    }
    mesh.positions.resize(kept);
    for (glm::uvec3& face : mesh.faces) face = {new_index[face[0]], new_index[face[1]], new_index[face[2]]};
}

struct Format {
    std::string_view ending;
    SurfacePolygons (*read)(const fs::path& file, std::string_view content, Notes& notes);
    bool repeats_vertices;
};
constexpr std::array<Format, 6> kFormats = {{{".obj", read_obj, false},
                                             {".stl", read_stl, true},
                                             {".ply", read_ply, false},
                                             {".off", read_off, false},
                                             {".gltf", read_gltf, true},
                                             {".glb", read_gltf, true}}};

const Format* find_format(const fs::path& file) {
    const std::string ending = lower_case_ending(file);
    const auto* const found = std::find_if(kFormats.begin(), kFormats.end(),
                                           [&](const Format& format) { return format.ending == ending; });
    return found == kFormats.end() ? nullptr : found;
}

// Text of old Macintoshes ends its lines with CR alone.
void replace_line_ends(std::string& content) {
    if (content.find('\0') != std::string::npos || content.find('\n') != std::string::npos) return;
    std::replace(content.begin(), content.end(), '\r', '\n');
}

}  // namespace

bool is_surface_file(const fs::path& file) {
    return find_format(file) != nullptr;
}

namespace {

struct Read {
    SurfacePolygons polygons;
    bool repeats_vertices;
};

[[noreturn]] void fail(const fs::path& file, const std::string& problem) {
    throw InvalidInput({file.string(), 0, {}, {}, problem});
}

Read read_polygons(const fs::path& file, Notes& notes) {
    const Format* const format = find_format(file);
    if (format == nullptr && !fs::exists(file)) fail(file, "no such file");
    if (format == nullptr) fail(file, "a surface file must end in .obj, .stl, .ply, .off, .gltf or .glb");
    std::string content = read_file(file);
    if (content.starts_with("\xef\xbb\xbf")) content.erase(0, 3);  // a byte order mark
    if (content.empty()) fail(file, "is empty");
    replace_line_ends(content);
    refuse_foreign_content(file, format->ending, content);

    const std::size_t noted = notes.size();
    SurfacePolygons polygons = format->read(file, content, notes);
    if (polygons.sizes.empty()) {
        const std::string ignored = joined(std::span(notes).subspan(noted));
        fail(file,
             fmt::format("has {} and no faces{}{}", counted(polygons.positions.size(), "vertex", "vertices"),
                         ignored.empty() ? "" : "; ", ignored));
    }
    return {std::move(polygons), format->repeats_vertices};
}

}  // namespace

std::vector<glm::dvec3> read_vertices(const fs::path& file) {
    Notes notes;
    return read_polygons(file, notes).polygons.positions;
}

SurfaceMesh read_surface(const fs::path& file, Notes& notes) {
    Read read = read_polygons(file, notes);
    SurfaceMesh mesh = triangulate(std::move(read.polygons), notes);
    if (mesh.faces.empty()) fail(file, "has no faces of three corners or more");
    if (read.repeats_vertices) share_vertices(mesh);
    move_near_origin(mesh, notes);
    repair_surface(mesh, notes);
    if (mesh.faces.empty()) fail(file, "has no faces with an area");
    return mesh;
}

}  // namespace gelatin
