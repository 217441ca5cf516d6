#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "model/layouts.h"
#include "model/range.h"

namespace gelatin {

/// Triangles with the same material.
struct MaterialTriangles {
    Range triangles;
    std::uint32_t material;  ///< index in Skin::look
};

/// Faces to draw, over surface vertices (nodes, or points of a skin, split at creases), and the faces around
/// each vertex.
struct DrawSurface {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> vertex_faces;  ///< indices of faces
    std::vector<glm::uvec3> triangles;        ///< indices into vertices, shape [faces]: face f's corners

    // Of surfaces with materials, else empty. Their triangles come last, those of a material together, so
    // that they are in another order than the faces.
    std::vector<glm::vec2> uvs;  ///< shape [vertices]
    std::vector<MaterialTriangles> materials;
};

}  // namespace gelatin
