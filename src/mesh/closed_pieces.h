#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace gelatin {

/// Closed sets of faces that are connected by edges, not by mere vertices: cavities may touch. Each
/// ascending, in the order of their first faces.
std::vector<std::vector<std::uint32_t>> find_closed_pieces(std::span<const glm::uvec3> faces);

/// The surfaces of the cavities that tets enclose, counter-clockwise as seen from the tets: so they enclose a
/// positive volume. In the order of their first faces in the mesh.
std::vector<std::vector<glm::uvec3>> find_hollows(const TetMesh& mesh);

}  // namespace gelatin
