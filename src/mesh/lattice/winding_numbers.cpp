#include "mesh/lattice/winding_numbers.h"

#include "mesh/lattice/caps.h"

namespace gelatin::lattice {
namespace {

std::vector<Triangle> with_caps(const SurfaceMesh& surface, const SurfaceMesh& caps) {
    std::vector<Triangle> triangles;
    for (const SurfaceMesh* mesh : {&surface, &caps}) {
        for (const glm::uvec3& f : mesh->faces)
            triangles.push_back({mesh->positions[f[0]], mesh->positions[f[1]], mesh->positions[f[2]]});
    }
    return triangles;
}

}  // namespace

WindingNumbers::WindingNumbers(const SurfaceMesh& surface)
    : WindingNumbers(surface, {surface.positions, find_caps(surface.faces)}) {}

WindingNumbers::WindingNumbers(const SurfaceMesh& surface, const SurfaceMesh& caps)
    : caps_(caps, 2), of_caps_(caps_), closed_(with_caps(surface, caps)) {}

}  // namespace gelatin::lattice
