#pragma once

#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"

namespace gelatin {

/// Geodesic sphere: each face of an icosahedron cut into frequency^2, vertices pushed onto the sphere.
/// 10 frequency^2 + 2 vertices, 20 frequency^2 faces.
SurfaceMesh make_sphere(const SphereShape& shape);

/// Box centred on the origin, each side a grid of quads cut into triangles.
SurfaceMesh make_box(const BoxShape& shape);

/// Capsule along y, centred on the origin.
SurfaceMesh make_capsule(const CapsuleShape& shape);

/// Letters of an installed font, extruded along z, centred on the origin; holes are kept. Outlines are flattened to
/// about 1% of the em. Letters that touch are one closed surface each only if they do not overlap.
/// @throws InvalidInput if the font is not installed, or the text has no visible outline.
SurfaceMesh make_text(const TextShape& shape);

}  // namespace gelatin
