#pragma once

#include <optional>
#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"
#include "mesh/tet_mesh.h"

namespace gelatin {

/// What is wrong with a mesh that a program has made, and where.
struct MeshProblem {
    const char* array = "";  ///< "vertices", "triangles", "tets" or "attributes"; empty: the whole mesh
    std::optional<std::size_t> index = {};  ///< in the array
    std::string value = {}, problem = {};
};

/// The first reason for which a mesh cannot be used: nothing in it, triangles and tets at once, coordinates
/// that are not finite, indices out of range, attributes that do not fit. Empty: there is none.
std::optional<MeshProblem> find_problem(const Mesh& mesh);

/// As read_surface and read_tets return them, with the same repairs and notes.
/// @param name for messages: the object's @pre !find_problem(mesh), and it has triangles, or tets
/// @throws InvalidInput if no face has an area, or a tet is flat
SurfaceMesh surface_in_memory(const Mesh& mesh, const std::string& name, Notes& notes);
TetMesh tets_in_memory(const Mesh& mesh, const std::string& name, Notes& notes);

}  // namespace gelatin
