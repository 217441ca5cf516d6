#pragma once

#include <string>

#include "gelatin/scene.h"
#include "mesh/surface_mesh.h"

namespace gelatin {

/// Geodesic sphere: each face of an icosahedron divided into frequency^2, with vertices projected onto the
/// sphere. 10 frequency^2 + 2 vertices, 20 frequency^2 faces.
SurfaceMesh make_sphere(const SphereShape& shape);

/// Box centred on the origin, each side a grid of quads divided into triangles.
SurfaceMesh make_box(const BoxShape& shape);

/// Capsule along y, centred on the origin.
SurfaceMesh make_capsule(const CapsuleShape& shape);

/// Letters of an installed font, extruded along z, centred on the origin. Holes are kept, overlapping letters
/// are united, lines end with '\n'. Outlines are flattened to half a percent of the em.
/// @throws InvalidInput if the font is not installed or lacks a letter, or if the text is not UTF-8 or has no
///   visible letter.
SurfaceMesh make_text(const TextShape& shape);

}  // namespace gelatin
