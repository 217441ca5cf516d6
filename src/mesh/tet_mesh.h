#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gelatin {

/// A tetrahedral mesh: (b-a) x (c-a) . (d-a) > 0 for each tet (a, b, c, d).
struct TetMesh {
    std::vector<glm::dvec3> positions;  ///< [m], shape [nodes]
    std::vector<glm::uvec4> tets;       ///< node indices, shape [tets]
    std::vector<glm::uvec3> faces;      ///< boundary triangles, counter-clockwise from outside, shape [faces]
    /// The region of each tet, by the file's own numbers, shape [tets]; empty if there is only one.
    std::vector<int> attributes = {};
};

}  // namespace gelatin
