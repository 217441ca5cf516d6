#pragma once

#include <vector>

#include "gelatin/scene.h"
#include "mesh/tet_mesh.h"
#include "model/layouts.h"

namespace gelatin {

/// The springs of a tet mesh (paper 2.2), each pair of nodes at most once, first node smaller, in ascending
/// order.
///
/// - structural: the edges of the tets;
/// - shear: the opposite corners of two tets that share a face;
/// - flex: the opposite corners of two boundary faces that share an edge; inside, for each edge at a node,
///   the straightest continuation by a second edge, if it bends by less than 30 degrees.
///
/// A pair that several kinds select belongs to the first of them. Each kind gets a share of the continuum's
/// stiffness, k = share E V_s / l^2 normalised so that sum(k l^2) = 6 E V. For structural springs alone this
/// is Van Gelder's k = E V_e / l^2 with V_e the volume of the tets around the edge (Van Gelder, "Approximate
/// simulation of elastic membranes by triangulated spring meshes", JGT 3(2), 1998, 3-D form). Derivation and
/// shares: docs/springs.md.
///
/// @param youngs_modulus [Pa]
std::vector<Spring> make_springs(const TetMesh& mesh, const SpringKinds& kinds, double youngs_modulus);

}  // namespace gelatin
