#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "mesh/surface_look.h"

namespace gelatin {

/// A triangle mesh. Faces wind counter-clockwise seen from outside.
struct SurfaceMesh {
    std::vector<glm::dvec3> positions;  ///< [m], shape [vertices]
    std::vector<glm::uvec3> faces;      ///< vertex indices, shape [faces]
    SurfaceLook look = {};
};

/// One line for the user for each repair of an input.
using Notes = std::vector<std::string>;

}  // namespace gelatin
