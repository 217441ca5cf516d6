#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "mesh/surface_mesh.h"

namespace gelatin {

/// What a surface file contains, before its polygons become triangles. Indices are in range, coordinates are
/// finite and fit into floats.
struct SurfacePolygons {
    std::vector<glm::dvec3> positions;             ///< shape [vertices]
    std::vector<std::uint32_t> corners;            ///< vertex indices, polygon by polygon; shape [corners]
    std::vector<std::uint32_t> sizes;              ///< corners of each polygon, any number; shape [polygons]
    std::vector<glm::vec2> corner_uvs;             ///< as in SurfaceLook; empty, or shape [corners]
    std::vector<std::uint32_t> polygon_materials;  ///< indices into materials, or SurfaceLook::kNone; empty,
                                                   ///< or shape [polygons]
    std::vector<SurfaceMaterial> materials;
};

/// Triangulates polygons. No vertices are added, and each edge of a polygon is an edge of one of its
/// triangles, so that what was closed stays closed. Polygons of fewer than three different corners are
/// ignored, with a line in `notes`; so is said how many outlines cross themselves.
SurfaceMesh triangulate(SurfacePolygons polygons, Notes& notes);

}  // namespace gelatin
