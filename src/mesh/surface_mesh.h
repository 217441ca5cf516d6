#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "mesh/notes.h"
#include "mesh/surface_look.h"

namespace gelatin {

/// A triangle mesh. Faces wind counter-clockwise seen from outside.
struct SurfaceMesh {
    std::vector<glm::dvec3> positions;  ///< [m], shape [vertices]
    std::vector<glm::uvec3> faces;      ///< vertex indices, shape [faces]
    SurfaceLook look = {};
};

}  // namespace gelatin
