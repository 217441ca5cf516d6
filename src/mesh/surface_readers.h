#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/surface_polygons.h"
#include "mesh/vertex_motion.h"

namespace gelatin {

/// Each reads one format as other programs write it, in double precision, without repair. What a file
/// contains beyond polygons and how they look is ignored, with a line in `notes` for each kind. Normals, and
/// names of groups and objects, say nothing that a body needs; they have no line.
/// @param content of the file; materials and images are found beside `file`, and those that cannot be read
/// are
///   left out, with a line
/// @throws InvalidInput naming file, line and field: counts that the file is too short for, a truncated file,
///   coordinates that are not finite, vertex indices out of range
SurfacePolygons read_obj(const std::filesystem::path& file, std::string_view content, Notes& notes);
SurfacePolygons read_off(const std::filesystem::path& file, std::string_view content, Notes& notes);
SurfacePolygons read_ply(const std::filesystem::path& file, std::string_view content, Notes& notes);
SurfacePolygons read_stl(const std::filesystem::path& file, std::string_view content, Notes& notes);

/// True for the content of an STL file, text or binary, whatever its name.
bool seems_stl(const std::filesystem::path& file, std::string_view content);

/// Triangles of the default scene, as its nodes, skins and morph targets place them without a clip. Text or
/// binary, glTF 2.0.
SurfacePolygons read_gltf(const std::filesystem::path& file, std::string_view content, Notes& notes);
/// The vertices of read_gltf in the same order, moved by the clip of this name, or by the first.
SkinnedVertices read_gltf_vertices(const std::filesystem::path& file, const std::string& clip);
/// Its bones: a joint for each node that a skin uses, or for each node where there is no skin, without
/// vertices.
SkinnedVertices read_gltf_bones(const std::filesystem::path& file, const std::string& clip);

}  // namespace gelatin
