#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

using Json = nlohmann::ordered_json;

/// Radius of a tet's circumscribed sphere over its shortest edge: 0.61 for a regular one, TetGen's -q.
double radius_edge_ratio(const TetMesh& mesh, const glm::uvec4& tet);

/// Counts, extent, closedness and volume of a surface; counts, extent, volume and quality of tets. SI units.
Json describe_surface(const SurfaceMesh& mesh);
Json describe_tets(const TetMesh& mesh);

/// One "key: value" a line, nested keys indented, for people.
std::string to_text(const Json& description);

/// To stderr, a line each, as "gelatin: note: ...".
void print_notes(const Notes& notes);

}  // namespace gelatin
