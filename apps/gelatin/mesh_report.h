#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

using Json = nlohmann::ordered_json;

/// Radius of a tet's circumscribed sphere divided by its shortest edge: 0.61 for a regular tet; TetGen's -q.
double radius_edge_ratio(const TetMesh& mesh, const glm::uvec4& tet);

/// Counts, extent, closedness and volume of a surface; counts, extent, volume and quality of tets. SI units.
Json describe_surface(const SurfaceMesh& mesh);
Json describe_tets(const TetMesh& mesh);

/// Adds how often each radius ratio and each angle between two faces occurs to what describe_tets made.
void add_histograms(const TetMesh& mesh, Json& description);

/// Human-readable, histograms as bars: one "key: value" in each line, nested keys indented.
std::string to_text(const Json& description);

/// Prints to stderr, one line each, as "gelatin: note: ...".
void print_notes(const Notes& notes);

}  // namespace gelatin
