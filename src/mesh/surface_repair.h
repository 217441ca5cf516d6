#pragma once

#include "mesh/surface_mesh.h"

namespace gelatin {

/// Merges coincident vertices (within 1e-9 of the bounding box' diagonal), discards degenerate and duplicate
/// faces and vertices without faces, and makes the winding consistent across shared edges and outward
/// (positive volume) in each connected component. Closed components inside others become cavities, whose
/// winding is inward, or bodies (orient_faces_outward); those that overlap another body are discarded. So
/// faces are between the body and the space around it. Adds one line to `notes` for each kind of repair that
/// changed something, and for cavities.
void repair_surface(SurfaceMesh& mesh, Notes& notes);

/// The edges that do not have exactly two faces.
struct Openness {
    std::size_t boundary_edges = 0;      ///< edges of one face
    std::size_t non_manifold_edges = 0;  ///< edges of three or more
    bool is_closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
};
Openness measure_openness(const SurfaceMesh& mesh);

/// Enclosed volume by the divergence theorem [m^3]; positive if faces wind outwards.
double signed_volume(const SurfaceMesh& mesh);

}  // namespace gelatin
