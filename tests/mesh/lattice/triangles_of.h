#pragma once

#include <vector>

#include "mesh/lattice/face_tree.h"
#include "mesh/surface_mesh.h"

namespace gelatin::lattice {

inline std::vector<Triangle> triangles_of(const SurfaceMesh& surface) {
    std::vector<Triangle> triangles;
    for (const glm::uvec3& f : surface.faces)
        triangles.push_back({surface.positions[f[0]], surface.positions[f[1]], surface.positions[f[2]]});
    return triangles;
}

}  // namespace gelatin::lattice
